#include <hagen/avoidance/WorldModel.h>
#include <algorithm>

#include "Commands.h"

namespace hagen {

void takesWorldModels(Flag flag, const std::vector<std::string>& also) {
    const auto errorOf = [also](const std::string& name) -> std::string {
        const std::vector<std::string>& known = avoidance::worldModelNames();
        const auto isIn = [&name](const std::vector<std::string>& names) {
            return std::find(names.begin(), names.end(), name) != names.end();
        };
        if (isIn(known) || isIn(also)) return "";
        return "unknown world model '" + name + "'; known are " + avoidance::worldModelList();
    };
    flag.transform(avoidance::worldModelFrom).check(errorOf, "");
}

}  // namespace hagen
