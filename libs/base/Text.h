#pragma once
#include <algorithm>
#include <cctype>
#include <string>
#include <string_view>

namespace hagen::base {

inline bool endsWith(std::string_view text, std::string_view ending) {
    return text.size() >= ending.size() && text.substr(text.size() - ending.size()) == ending;
}

/// Returns the text with ASCII letters in lower case.
inline std::string lowerCase(std::string text) {
    std::transform(text.begin(), text.end(), text.begin(),
                   [](unsigned char letter) { return static_cast<char>(std::tolower(letter)); });
    return text;
}

}  // namespace hagen::base
