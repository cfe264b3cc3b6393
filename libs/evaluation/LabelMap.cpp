#include <hagen/evaluation/LabelMap.h>
#include <set>
#include <stdexcept>
#include "base/NumberText.h"

#include "evaluation/YamlFile.h"

namespace hagen::evaluation {
namespace {

constexpr const char* kExample = "70: {name: vegetation, label: 2}";

std::uint16_t kindNumber(const std::string& text) {
    if (const auto number = base::numberFrom<std::uint16_t>(text)) return *number;
    throw std::invalid_argument("'" + text + "' is not a class number (0 to 65535)");
}

SemanticClass classOf(const YAML::Node& node) {
    if (!node.IsMap() || node.size() != 2 || !node["name"] || !node["label"] ||
        !node["name"].IsScalar() || !node["label"].IsScalar() || node["name"].Scalar().empty()) {
        throw std::invalid_argument(std::string("expected name and label, as in '") + kExample +
                                    "'");
    }
    const std::string label = node["label"].Scalar();
    if (label != "0" && label != "1" && label != "2") {
        throw std::invalid_argument("label '" + label + "' is not 0 (ignored), 1 (ROU) or 2 (RoI)");
    }
    return {node["name"].Scalar(), static_cast<Label>(label[0] - '0')};
}

}  // namespace

LabelMap readLabelMap(const std::filesystem::path& file) {
    LabelMap map;
    std::set<std::string> names;
    forEachYamlEntry(file, kExample, [&](const std::string& key, const YAML::Node& value) {
        const SemanticClass kind = classOf(value);
        if (!names.insert(kind.name).second) {
            throw std::invalid_argument("two classes are named '" + kind.name + "'");
        }
        map.emplace(kindNumber(key), kind);
    });
    return map;
}

std::vector<Label> labelsOfClasses(const std::vector<std::uint16_t>& kinds, const LabelMap& map) {
    std::vector<Label> labels;
    labels.reserve(kinds.size());
    for (const std::uint16_t kind : kinds) {
        const auto entry = map.find(kind);
        if (entry == map.end()) {
            throw std::invalid_argument("class " + std::to_string(kind) +
                                        " is not in the label map; add a line for it");
        }
        labels.push_back(entry->second.label);
    }
    return labels;
}

std::vector<Label> labelsOfNumbers(const std::vector<std::uint16_t>& numbers) {
    std::vector<Label> labels;
    labels.reserve(numbers.size());
    for (const std::uint16_t number : numbers) {
        if (number > static_cast<std::uint16_t>(Label::Roi)) {
            throw std::invalid_argument("label " + std::to_string(number) +
                                        " is not 0 (unclassified), 1 (ROU) or 2 (RoI); other "
                                        "classes need a --label-map");
        }
        labels.push_back(static_cast<Label>(number));
    }
    return labels;
}

}  // namespace hagen::evaluation
