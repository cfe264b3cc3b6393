#include "recordings/bags/FrameTree.h"

namespace hagen::recordings {
namespace {

constexpr int kMaxTreeDepth = 64;

}  // namespace

bool FrameTree::add(const std::string& parent, const std::string& child,
                    const mrpt::poses::CPose3D& pose) {
    if (parent == child || (edges_.size() >= kMaxFrames && edges_.count(child) == 0)) {
        return false;
    }
    edges_[child] = {parent, pose};
    return true;
}

bool FrameTree::has(const std::string& frame) const {
    if (edges_.count(frame) > 0) return true;
    for (const auto& [child, edge] : edges_) {
        if (edge.parent == frame) return true;
    }
    return false;
}

/// The root above a frame, and the frame's pose in it.
FrameTree::Edge FrameTree::climb(const std::string& frame) const {
    Edge root{frame, {}};
    for (int depth = 0; depth < kMaxTreeDepth; ++depth) {
        const auto edge = edges_.find(root.parent);
        if (edge == edges_.end()) break;
        root = {edge->second.parent, edge->second.pose + root.pose};
    }
    return root;
}

std::optional<mrpt::poses::CPose3D> FrameTree::poseIn(const std::string& frame,
                                                      const std::string& in) const {
    if (frame == in) return mrpt::poses::CPose3D();
    const Edge of_frame = climb(frame), of_other = climb(in);
    if (of_frame.parent != of_other.parent) return std::nullopt;
    return (-of_other.pose) + of_frame.pose;
}

}  // namespace hagen::recordings
