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
        return "unknown world model '" + name + "'; known: " + avoidance::worldModelList();
    };
    flag.transform(avoidance::worldModelFrom).check(errorOf);
}

std::vector<std::string> namesFrom(const std::string& flag, const std::vector<std::string>& names,
                                   const std::vector<std::string>& all) {
    if (names == std::vector<std::string>{"all"}) return all;
    if (std::find(names.begin(), names.end(), "all") != names.end()) {
        throw UsageError(flag, "all cannot be combined with other values");
    }
    requireOnce(flag, names);
    return names;
}

}  // namespace hagen
