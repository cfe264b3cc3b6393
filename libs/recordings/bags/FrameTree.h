#pragma once
#include <mrpt/poses/CPose3D.h>

#include <cstddef>
#include <map>
#include <optional>
#include <string>

namespace hagen::recordings {

/// Frames that do not move against each other, by tf_static.
class FrameTree {
 public:
    static constexpr std::size_t kMaxFrames = 10000;

    /// The pose of `child` in `parent`. A later one replaces it. False, and nothing is added, for a
    /// frame on itself, and if there are kMaxFrames others.
    bool add(const std::string& parent, const std::string& child, const mrpt::poses::CPose3D& pose);

    bool has(const std::string& frame) const;
    /// The frame that this one hangs on in the end; itself if on none. Ends where frames go round
    /// in a circle.
    std::string rootOf(const std::string& frame) const;
    /// The pose of a frame in another one; none if they do not hang together.
    std::optional<mrpt::poses::CPose3D> poseIn(const std::string& frame,
                                               const std::string& in) const;

 private:
    struct Edge {
        std::string parent;
        mrpt::poses::CPose3D pose;
    };
    mrpt::poses::CPose3D poseInRoot(const std::string& frame) const;

    std::map<std::string, Edge> edges_;  ///< by child
};

}  // namespace hagen::recordings
