#include "settings/YamlParts.h"

#include <yaml-cpp/eventhandler.h>
#include "base/ReadFile.h"

#include <algorithm>
#include <numeric>
#include <sstream>

namespace hagen {

namespace fs = std::filesystem;

std::string at(const fs::path& file, const YAML::Node& node) {
    const YAML::Mark mark = node.Mark();
    return file.string() + (mark.is_null() ? "" : ":" + std::to_string(mark.line + 1)) + ": ";
}

namespace {

std::size_t editDistance(const std::string& a, const std::string& b) {
    std::vector<std::size_t> row(b.size() + 1);
    std::iota(row.begin(), row.end(), 0);
    for (std::size_t i = 1; i <= a.size(); ++i) {
        std::size_t diagonal = row[0];
        row[0] = i;
        for (std::size_t j = 1; j <= b.size(); ++j) {
            const std::size_t substituted = diagonal + (a[i - 1] != b[j - 1]);
            diagonal = row[j];
            row[j] = std::min({substituted, row[j] + 1, row[j - 1] + 1});
        }
    }
    return row.back();
}

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

std::string nearestOf(const std::string& word, const std::vector<std::string>& known) {
    return *std::min_element(known.begin(), known.end(), [&](const auto& a, const auto& b) {
        return editDistance(word, a) < editDistance(word, b);
    });
}

std::string unknownKey(const std::string& key, const std::vector<std::string>& known) {
    return "unknown key '" + key + "'; did you mean '" + nearestOf(key, known) + "'?";
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
