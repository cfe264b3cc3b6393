#include "evaluation/YamlFile.h"

#include <set>
#include <stdexcept>
#include "base/ReadFile.h"

namespace hagen::evaluation {

namespace fs = std::filesystem;

std::string yamlPlace(const fs::path& file, const YAML::Node& node) {
    const YAML::Mark mark = node.Mark();
    return file.string() + (mark.is_null() ? "" : ":" + std::to_string(mark.line + 1)) + ": ";
}

void forEachYamlEntry(
    const fs::path& file, const std::string& example,
    const std::function<void(const std::string& key, const YAML::Node& value)>& entry) {
    if (!fs::is_regular_file(file)) throw std::runtime_error(file.string() + ": no such file");
    YAML::Node document;
    try {
        document = YAML::Load(base::readText(file));
    } catch (const YAML::ParserException& e) {
        throw std::runtime_error(file.string() + ":" + std::to_string(e.mark.line + 1) +
                                 ": not YAML: " + e.msg);
    } catch (const YAML::Exception&) {
        throw std::runtime_error(file.string() + ": cannot be read");
    }
    if (!document.IsMap()) {
        throw std::runtime_error(file.string() + ": expected lines such as '" + example + "'");
    }
    std::set<std::string> seen;
    for (const auto& pair : document) {
        const YAML::Node &key = pair.first, &value = pair.second;
        const std::string name = key.IsScalar() ? key.Scalar() : "";
        if (!seen.insert(name).second) {
            throw std::runtime_error(yamlPlace(file, key) + "'" + name + "' occurs twice");
        }
        try {
            entry(name, value);
        } catch (const std::exception& e) {
            throw std::runtime_error(yamlPlace(file, value) + e.what());
        }
    }
}

}  // namespace hagen::evaluation
