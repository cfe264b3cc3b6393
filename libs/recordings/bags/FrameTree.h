#pragma once
#include <mrpt/poses/CPose3D.h>

#include <cstddef>
#include <map>
#include <optional>
#include <string>

namespace hagen::recordings {

/// Rigidly connected frames, from tf_static.
class FrameTree {
 public:
    static constexpr std::size_t kMaxFrames = 10000;

    /// Adds or replaces the pose of `child` in `parent`. Returns false without effect if both are
    /// the same frame, or if there are already kMaxFrames others.
    bool add(const std::string& parent, const std::string& child, const mrpt::poses::CPose3D& pose);

    bool has(const std::string& frame) const;
    /// The root above a frame; the frame itself if it has no parent. Stops at a cycle.
    std::string rootOf(const std::string& frame) const { return climb(frame).parent; }
    /// The pose of a frame in another frame; nullopt if the frames are not connected.
    std::optional<mrpt::poses::CPose3D> poseIn(const std::string& frame,
                                               const std::string& in) const;

 private:
    struct Edge {
        std::string parent;
        mrpt::poses::CPose3D pose;
    };
    Edge climb(const std::string& frame) const;

    std::map<std::string, Edge> edges_;  ///< edge to the parent, by child
};

}  // namespace hagen::recordings
