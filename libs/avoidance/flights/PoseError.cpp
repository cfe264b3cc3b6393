#include <hagen/avoidance/PoseError.h>

#include "avoidance/flights/Words.h"

namespace hagen::avoidance {

std::string nameOf(PoseError error) { return kPoseErrors[static_cast<std::size_t>(error)]; }

PoseError poseErrorFrom(const std::string& name) {
    try {
        return wordFrom<PoseError>(name, kPoseErrors);
    } catch (const std::runtime_error& e) {
        throw std::invalid_argument(std::string("pose error: ") + e.what());
    }
}

}  // namespace hagen::avoidance
