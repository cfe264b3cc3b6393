#include "base/Json.h"

#include <stdexcept>

namespace hagen::base {

nlohmann::json parseJson(const std::string& text) {
    constexpr int kMaxNesting = 64;  // dump() calls itself once per level
    const auto checkDepth = [](int depth, nlohmann::json::parse_event_t, nlohmann::json&) {
        if (depth < kMaxNesting) return true;
        throw std::runtime_error("is nested too deeply: more than " + std::to_string(kMaxNesting) +
                                 " levels of arrays and objects");
    };
    try {
        return nlohmann::json::parse(text, checkDepth);
    } catch (const nlohmann::json::exception& e) {
        const std::string reason = e.what();     // such as "[json.exception...] reason"
        constexpr std::size_t kMaxLength = 300;  // the reason quotes the text
        throw std::runtime_error("is not valid JSON: " +
                                 reason.substr(reason.find("] ") + 2, kMaxLength));
    }
}

std::string dumpJson(const Json& json, int indent) {
    return json.dump(indent, ' ', false, Json::error_handler_t::replace);
}

}  // namespace hagen::base
