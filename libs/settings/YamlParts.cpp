#include "settings/YamlParts.h"
#include "base/Text.h"

#include <yaml-cpp/eventhandler.h>
#include "base/ReadFile.h"

#include <sstream>

namespace hagen {

namespace fs = std::filesystem;

std::string at(const fs::path& file, const YAML::Node& node) {
    const YAML::Mark mark = node.Mark();
    return file.string() + (mark.is_null() ? "" : ":" + std::to_string(mark.line + 1)) + ": ";
}

namespace {

/// Ignores the content of a document.
struct NoNodes : YAML::EventHandler {
    void OnDocumentStart(const YAML::Mark&) override {}
    void OnDocumentEnd() override {}
    void OnNull(const YAML::Mark&, YAML::anchor_t) override {}
    void OnAlias(const YAML::Mark&, YAML::anchor_t) override {}
    void OnScalar(const YAML::Mark&, const std::string&, YAML::anchor_t,
                  const std::string&) override {}
    void OnSequenceStart(const YAML::Mark&, const std::string&, YAML::anchor_t,
                         YAML::EmitterStyle::value) override {}
    void OnSequenceEnd() override {}
    void OnMapStart(const YAML::Mark&, const std::string&, YAML::anchor_t,
                    YAML::EmitterStyle::value) override {}
    void OnMapEnd() override {}
};

/// True if a second document follows. (YAML::LoadAll() hangs on a file such as ",".)
bool hasSeveralDocuments(const std::string& text) {
    std::istringstream in(text);
    YAML::Parser parser(in);
    NoNodes nodes;
    return parser.HandleNextDocument(nodes) && parser.HandleNextDocument(nodes);
}

}  // namespace

std::string unknownKey(const std::string& key, const std::vector<std::string>& known) {
    return "unknown key '" + key + "'" + base::didYouMean(key, known);
}

YAML::Node parseFile(const fs::path& file, std::size_t max_bytes) {
    if (!fs::exists(file)) throw SettingsError(file.string() + ": no such settings file");
    try {
        const std::string text = base::readText(file, max_bytes);
        if (hasSeveralDocuments(text)) {
            throw SettingsError(file.string() +
                                ": contains several documents (---) or invalid YAML; only one "
                                "document is allowed");
        }
        return YAML::Load(text);
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
