#pragma once
#include <zlib.h>
#include <cstdint>
#include <map>
#include <stdexcept>
#include <string>
#include <vector>
#include "base/Json.h"

namespace hagen::test {

/// The JSON of a page of the viewer.
inline nlohmann::json viewData(const std::string& page) {
    const std::string begin = "<script type=\"application/json\" id=\"data\">";
    const std::size_t from = page.find(begin) + begin.size();
    return nlohmann::json::parse(page.substr(from, page.find("</script>", from) - from));
}

/// The arrays of a frame, decoded as docs/view.md says.
inline std::map<std::string, std::vector<std::int64_t>> viewArrays(const nlohmann::json& packed) {
    const std::string digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string deflated;
    std::uint32_t bits = 0;
    int known = 0;
    for (const char c : packed.at("data").get<std::string>()) {
        if (c == '=') break;
        bits = bits << 6 | static_cast<std::uint32_t>(digits.find(c));
        if ((known += 6) >= 8) deflated += static_cast<char>(bits >> (known -= 8) & 0xffu);
    }
    std::size_t bytes = 0;
    for (const auto& array : packed.at("arrays")) {
        bytes +=
            std::stoul(array[1].get<std::string>().substr(1)) / 8 * array[2].get<std::size_t>();
    }
    std::vector<std::uint8_t> raw(bytes);
    uLongf size = bytes;
    if (uncompress(raw.data(), &size, reinterpret_cast<const Bytef*>(deflated.data()),
                   deflated.size()) != Z_OK ||
        size != bytes) {
        throw std::runtime_error("the arrays of a frame do not match their directory");
    }
    std::map<std::string, std::vector<std::int64_t>> arrays;
    std::size_t at = 0;
    for (const auto& array : packed.at("arrays")) {
        const std::string type = array[1];
        const std::size_t width = std::stoul(type.substr(1)) / 8, count = array[2];
        std::vector<std::int64_t>& values = arrays[array[0]];
        std::uint64_t last = 0;
        for (std::size_t i = 0; i < count; ++i) {
            std::uint64_t value = 0;
            for (std::size_t byte = 0; byte < width; ++byte) {
                value |= std::uint64_t{raw[at + byte * count + i]} << (8 * byte);
            }
            if (array[3]) value = (value + last) & ((std::uint64_t{1} << (8 * width)) - 1);
            last = value;
            const bool is_negative = type[0] == 'i' && (value >> (8 * width - 1)) != 0;
            values.push_back(static_cast<std::int64_t>(value) -
                             (is_negative ? std::int64_t{1} << (8 * width) : 0));
        }
        at += width * count;
    }
    return arrays;
}

}  // namespace hagen::test
