#include "avoidance/replays/PackedNumbers.h"

#include <algorithm>
#include <cmath>

namespace hagen::avoidance {

void PackedNumbers::add(double value) {
    const auto whole =
        static_cast<std::int16_t>(std::lround(std::fmax(-32768, std::fmin(32767, value))));
    bytes_.push_back(static_cast<std::uint8_t>(whole & 0xff));
    bytes_.push_back(static_cast<std::uint8_t>((whole >> 8) & 0xff));
}

std::string PackedNumbers::text() const {
    constexpr char kDigits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text;
    text.reserve((bytes_.size() + 2) / 3 * 4);
    for (std::size_t i = 0; i < bytes_.size(); i += 3) {
        const std::size_t left = std::min<std::size_t>(3, bytes_.size() - i);
        std::uint32_t group = 0;
        for (std::size_t k = 0; k < 3; ++k) group = (group << 8) | (k < left ? bytes_[i + k] : 0u);
        for (std::size_t digit = 0; digit < 4; ++digit) {
            text += digit <= left ? kDigits[(group >> (18 - 6 * digit)) & 63u] : '=';
        }
    }
    return text;
}

}  // namespace hagen::avoidance
