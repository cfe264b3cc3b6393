#include "evaluation/YamlFile.h"

#include <stdexcept>
#include "settings/YamlParts.h"

namespace hagen::evaluation {

namespace fs = std::filesystem;

void forEachYamlEntry(
    const fs::path& file, const std::string& example,
    const std::function<void(const std::string& key, const YAML::Node& value)>& entry) {
    if (!fs::is_regular_file(file)) throw std::runtime_error(file.string() + ": no such file");
    const YAML::Node document = parseFile(file);
    if (!document.IsMap()) {
        throw std::runtime_error(file.string() + ": expected lines such as '" + example + "'");
    }
    std::set<std::string> seen;
    for (const auto& pair : document) {
        const YAML::Node &key = pair.first, &value = pair.second;
        const std::string name = key.IsScalar() ? key.Scalar() : "";
        if (!seen.insert(name).second) {
            throw std::runtime_error(at(file, key) + "'" + name + "' occurs twice");
        }
        try {
            entry(name, value);
        } catch (const std::exception& e) {
            throw std::runtime_error(at(file, value) + e.what());
        }
    }
}

}  // namespace hagen::evaluation
