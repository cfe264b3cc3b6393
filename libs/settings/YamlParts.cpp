#include "settings/YamlParts.h"
#include "base/Text.h"

#include <utility>

namespace hagen {

namespace fs = std::filesystem;

std::string at(const fs::path& file, const YAML::Node& node) {
    const YAML::Mark mark = node.Mark();
    return file.string() + (mark.is_null() ? "" : ":" + std::to_string(mark.line + 1)) + ": ";
}

namespace {

/// Number of documents with content. (YAML::LoadAll() hangs on a file such as ",".)
int documentsIn(const std::string& text) {
    std::istringstream lines(text);
    int documents = 0;
    bool is_open = false;
    for (std::string line; std::getline(lines, line);) {
        if (line.rfind("---", 0) == 0) is_open = false;
        const bool is_content =
            !line.empty() && std::string("#%-\r").find(line[0]) == std::string::npos;
        if (is_content && !std::exchange(is_open, true)) ++documents;
    }
    return documents;
}

}  // namespace

std::string unknownKey(const std::string& key, const std::vector<std::string>& known) {
    return "unknown key '" + key + "'" + base::didYouMean(key, known);
}

YAML::Node parseFile(const fs::path& file, std::size_t max_bytes) {
    if (!fs::exists(file)) throw SettingsError(file.string() + ": no such settings file");
    try {
        const std::string text = base::readText(file, max_bytes);
        YAML::Node document = YAML::Load(text);
        const int documents = documentsIn(text);
        if (documents > 1 || (documents == 1 && document.IsNull())) {
            throw SettingsError(file.string() +
                                ": contains several documents (---) or invalid YAML; only one "
                                "document is allowed");
        }
        return document;
    } catch (const SettingsError&) {
        throw;
    } catch (const YAML::ParserException& e) {
        throw SettingsError(file.string() + ":" + std::to_string(e.mark.line + 1) +
                            ": not YAML: " + e.msg);
    } catch (const YAML::Exception&) {
        throw SettingsError(file.string() + ": cannot be read");
    } catch (const std::runtime_error& e) {
        throw SettingsError(e.what());
    }
}

}  // namespace hagen
