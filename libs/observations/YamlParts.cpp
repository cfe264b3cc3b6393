#include "YamlParts.h"

#include <hagen/base/ReadFile.h>
#include <algorithm>
#include <numeric>

namespace hagen::observations {

namespace fs = std::filesystem;

/// The place of a value in a file, for messages.
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

}  // namespace

std::string nearestOf(const std::string& word, const std::vector<std::string>& known) {
    return *std::min_element(known.begin(), known.end(), [&](const auto& a, const auto& b) {
        return editDistance(word, a) < editDistance(word, b);
    });
}

std::string unknownKey(const std::string& key, const std::vector<std::string>& known) {
    return "unknown key '" + key + "'; did you mean '" + nearestOf(key, known) + "'?";
}

YAML::Node parseFile(const fs::path& file) {
    if (!fs::exists(file)) throw SettingsError(file.string() + ": no such settings file");
    if (fs::is_directory(file)) throw SettingsError(file.string() + ": is a folder, not a file");
    try {
        const std::vector<YAML::Node> documents = YAML::LoadAll(base::readText(file));
        if (documents.size() > 1) {
            throw SettingsError(file.string() +
                                ": contains several documents (---); only one is allowed");
        }
        return documents.empty() ? YAML::Node() : documents.front();
    } catch (const SettingsError&) {
        throw;
    } catch (const YAML::ParserException& e) {
        throw SettingsError(file.string() + ":" + std::to_string(e.mark.line + 1) +
                            ": not YAML: " + e.msg);
    } catch (const std::exception&) {
        throw SettingsError(file.string() + ": cannot be read");
    }
}

}  // namespace hagen::observations
