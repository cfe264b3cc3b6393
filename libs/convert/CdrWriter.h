#pragma once
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace hagen::convert {

/// Writes the fields of a message as little-endian CDR, which FieldReader::ofCdr() reads: a
/// four-byte header, then the fields, with numbers aligned to their size.
class CdrWriter {
 public:
    CdrWriter() : bytes_{0, 1, 0, 0} {}

    void reserve(std::size_t bytes) { bytes_.reserve(bytes); }

    template <class Number>
    CdrWriter& number(Number value) {
        static_assert(std::is_integral_v<Number> || std::is_floating_point_v<Number>);
        constexpr std::size_t kSize = sizeof(Number);
        const std::size_t beyond = (bytes_.size() - kHeader) % kSize;
        if (beyond > 0) bytes_.resize(bytes_.size() + kSize - beyond, 0);
        std::uint8_t raw[kSize];
        std::memcpy(raw, &value, kSize);
        bytes_.insert(bytes_.end(), raw, raw + kSize);
        return *this;
    }

    /// Writes the number of elements that follow. Throws std::runtime_error if it exceeds 32 bits.
    CdrWriter& count(std::size_t elements) {
        if (elements > std::numeric_limits<std::uint32_t>::max()) {
            throw std::runtime_error("a message cannot hold " + std::to_string(elements) +
                                     " elements");
        }
        return number(static_cast<std::uint32_t>(elements));
    }

    CdrWriter& text(const std::string& text) {
        count(text.size() + 1);
        bytes_.insert(bytes_.end(), text.begin(), text.end());
        bytes_.push_back(0);
        return *this;
    }

    /// Writes a length prefix, then the bytes.
    CdrWriter& counted(const std::vector<std::uint8_t>& bytes) {
        count(bytes.size());
        bytes_.insert(bytes_.end(), bytes.begin(), bytes.end());
        return *this;
    }

    std::vector<std::uint8_t> take() { return std::move(bytes_); }

 private:
    static constexpr std::size_t kHeader = 4;
    std::vector<std::uint8_t> bytes_;
};

}  // namespace hagen::convert
