#include <hagen/avoidance/Planner.h>
#include <stdexcept>
#include "avoidance/planning/Planners.h"

namespace hagen::avoidance {

const std::vector<std::string>& plannerNames() {
    static const std::vector<std::string> names{"primitives", "3dvfh"};
    return names;
}

std::unique_ptr<Planner> makePlanner(const std::string& name) {
    if (name == "primitives") return std::make_unique<MotionPrimitives>();
    if (name == "3dvfh") return std::make_unique<PolarHistogram>();
    throw std::invalid_argument("unknown planner '" + name + "'; known: primitives, 3dvfh");
}

}  // namespace hagen::avoidance
