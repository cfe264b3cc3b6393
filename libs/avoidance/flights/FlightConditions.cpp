#include <hagen/avoidance/FlightConditions.h>

#include <algorithm>
#include <stdexcept>
#include "base/Text.h"

namespace hagen::avoidance {
namespace {

using Names = std::vector<std::string>;

// In the order of the enumerations.
const Names kPoseErrors{"none", "noise", "drift"}, kAirs{"dusty", "clear"},
    kDistances{"unbiased", "as-stored"}, kUpdates{"scans", "sectors"},
    kOutcomes{"success", "collision", "timeout"};

template <class Value>
const std::string& nameIn(const Names& names, Value value) {
    return names[static_cast<std::size_t>(value)];
}

template <class Value>
Value valueIn(const Names& names, const std::string& name) {
    const auto found = std::find(names.begin(), names.end(), name);
    if (found != names.end()) return static_cast<Value>(found - names.begin());
    throw std::invalid_argument("\"" + name + "\" is not one of " + base::joined(names));
}

}  // namespace

std::string nameOf(PoseError error) { return nameIn(kPoseErrors, error); }
std::string nameOf(Air air) { return nameIn(kAirs, air); }
std::string nameOf(ModelDistance distance) { return nameIn(kDistances, distance); }
std::string nameOf(Updates updates) { return nameIn(kUpdates, updates); }
std::string nameOf(Outcome outcome) { return nameIn(kOutcomes, outcome); }

PoseError poseErrorFrom(const std::string& name) { return valueIn<PoseError>(kPoseErrors, name); }
Air airFrom(const std::string& name) { return valueIn<Air>(kAirs, name); }
ModelDistance distanceFrom(const std::string& name) {
    return valueIn<ModelDistance>(kDistances, name);
}
Updates updatesFrom(const std::string& name) { return valueIn<Updates>(kUpdates, name); }
Outcome outcomeFrom(const std::string& name) { return valueIn<Outcome>(kOutcomes, name); }

}  // namespace hagen::avoidance
