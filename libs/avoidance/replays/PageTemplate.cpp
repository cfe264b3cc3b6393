#include "avoidance/replays/PageTemplate.h"

#include <stdexcept>

namespace hagen::avoidance {

std::string filled(std::string_view page, const std::map<std::string, std::string_view>& values) {
    std::string text;
    for (;;) {
        const std::size_t begin = page.find("{{");
        if (begin == std::string_view::npos) return text.append(page);
        const std::size_t end = page.find("}}", begin);
        const std::string name(page.substr(begin + 2, end - begin - 2));
        const auto value = values.find(name);
        if (value == values.end()) throw std::logic_error("the page has no value for " + name);
        text.append(page.substr(0, begin)).append(value->second);
        page.remove_prefix(end + 2);
    }
}

std::string scriptText(std::string json) {
    // In a string, "</script>" would end the element, and "<!--<script>" would hide its end. JSON
    // has a '<' only in strings.
    const std::string escaped = "\\u003c";
    for (std::size_t at = 0; (at = json.find('<', at)) != std::string::npos; at += escaped.size())
        json.replace(at, 1, escaped);
    return json;
}

}  // namespace hagen::avoidance
