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

std::string FrameTree::rootOf(const std::string& frame) const {
    std::string root = frame;
    for (int depth = 0; depth < kMaxTreeDepth; ++depth) {
        const auto edge = edges_.find(root);
        if (edge == edges_.end()) break;
        root = edge->second.parent;
    }
    return root;
}

mrpt::poses::CPose3D FrameTree::poseInRoot(const std::string& frame) const {
    mrpt::poses::CPose3D pose;
    std::string at = frame;
    for (int depth = 0; depth < kMaxTreeDepth; ++depth) {
        const auto edge = edges_.find(at);
        if (edge == edges_.end()) break;
        pose = edge->second.pose + pose;
        at = edge->second.parent;
    }
    return pose;
}

std::optional<mrpt::poses::CPose3D> FrameTree::poseIn(const std::string& frame,
                                                      const std::string& in) const {
    if (frame == in) return mrpt::poses::CPose3D();
    if (rootOf(frame) != rootOf(in)) return std::nullopt;
    return (-poseInRoot(in)) + poseInRoot(frame);
}

}  // namespace hagen::recordings
