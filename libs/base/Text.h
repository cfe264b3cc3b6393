#pragma once
#include <cctype>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

namespace hagen::base {

/// Joins words with a separator.
template <class Words>
std::string joined(const Words& words, const std::string& separator = ", ") {
    std::string text;
    for (const std::string& word : words) text += (text.empty() ? "" : separator) + word;
    return text;
}

/// Splits a text at a separator. Returns at least one part; parts may be empty.
inline std::vector<std::string> split(const std::string& text, char separator) {
    std::vector<std::string> parts;
    std::istringstream stream(text + separator);  // keeps an empty last part
    for (std::string part; std::getline(stream, part, separator);) parts.push_back(part);
    return parts;
}

/// Converts ASCII letters to lower case.
inline std::string lowerCase(std::string text) {
    for (char& letter : text) {
        letter = static_cast<char>(std::tolower(static_cast<unsigned char>(letter)));
    }
    return text;
}

/// Such as "; did you mean 'VLP-16'?", with the known word most similar to `word`, ignoring case;
/// empty if no words are known.
std::string didYouMean(const std::string& word, const std::vector<std::string>& known);

/// Length of the UTF-8 character at the start of a text, which may be truncated; 0 if the bytes are
/// not valid UTF-8.
std::size_t utf8Length(std::string_view text);

/// True if the text has this ending.
inline bool endsWith(const std::string& text, const std::string& ending) {
    return text.size() >= ending.size() &&
           text.compare(text.size() - ending.size(), ending.size(), ending) == 0;
}

}  // namespace hagen::base
