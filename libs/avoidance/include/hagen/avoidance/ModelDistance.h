#pragma once
#include <array>
#include <cstddef>
#include <string>

namespace hagen::avoidance {

/// Which distances a world model answers with. As they store obstacles, models measure differently:
/// windows to thinned points, maps to the faces of voxels. Unbiased: what that adds on average was
/// measured, and is subtracted.
enum class ModelDistance { Unbiased, AsStored };

/// In the order of ModelDistance.
constexpr std::array<const char*, 2> kModelDistances{"unbiased", "as-stored"};

inline std::string nameOf(ModelDistance distance) {
    return kModelDistances[static_cast<std::size_t>(distance)];
}

}  // namespace hagen::avoidance
