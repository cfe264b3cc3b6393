#pragma once
#include "base/NumberText.h"

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <stdexcept>
#include <string>
#include <type_traits>

namespace hagen::recordings {

/// Bytes in memory, not owned.
struct ByteView {
    const std::uint8_t* data = nullptr;
    std::size_t size = 0;
};

/// Thrown if the bytes end within a field.
struct TooShort : std::runtime_error {
    using std::runtime_error::runtime_error;
};

/// Reads the fields of a message or a record in order: packed and little-endian, as in ROS 1 and in
/// bag records, or as CDR (aligned; NUL-terminated texts; either byte order). Throws TooShort
/// instead of reading beyond the end. Checks sizes before allocating.
class FieldReader {
 public:
    explicit FieldReader(ByteView bytes) : bytes_(bytes) {}

    /// Reads a CDR message, which starts with a four-byte header with the byte order. Throws
    /// std::runtime_error for unsupported kinds of CDR (parameter lists, XCDR2).
    static FieldReader ofCdr(ByteView bytes);

    bool isCdr() const { return is_cdr_; }
    std::size_t left() const { return bytes_.size - at_; }

    template <class Number>
    Number number() {
        static_assert(std::is_arithmetic_v<Number>);
        align(sizeof(Number));
        const ByteView from = take(sizeof(Number));
        std::uint8_t raw[sizeof(Number)];
        for (std::size_t i = 0; i < sizeof raw; ++i) {
            raw[i] = from.data[swaps_ ? sizeof raw - 1 - i : i];
        }
        Number value;
        std::memcpy(&value, raw, sizeof value);
        return value;
    }

    /// Reads the number of elements that follow, each with at least `min_bytes` bytes.
    std::size_t count(std::size_t min_bytes) {
        const auto elements = number<std::uint32_t>();
        if (elements > left() / min_bytes) {
            throw TooShort("it claims " + base::counted(elements, "element") + ", but has only " +
                           base::counted(left(), "more byte"));
        }
        return elements;
    }

    std::string text() {
        ByteView chars = take(count(1));
        if (is_cdr_ && chars.size > 0) --chars.size;  // without the NUL
        return {reinterpret_cast<const char*>(chars.data), chars.size};
    }

    /// Returns the next bytes unparsed.
    ByteView take(std::size_t size) {
        if (size > left()) {
            throw TooShort("bytes missing at its end: " + std::to_string(size - left()));
        }
        const ByteView taken{bytes_.data + at_, size};
        at_ += size;
        return taken;
    }

    /// Skips the padding before a number of this size.
    void align(std::size_t size) {
        if (!is_cdr_) return;
        const std::size_t beyond = (at_ - start_) % size;
        if (beyond > 0) take(size - beyond);
    }

 private:
    ByteView bytes_;
    std::size_t at_ = 0, start_ = 0;  ///< CDR is aligned relative to the end of its header
    bool is_cdr_ = false, swaps_ = false;
};

inline FieldReader FieldReader::ofCdr(ByteView bytes) {
    FieldReader reader(bytes);
    const ByteView header = reader.take(4);
    if (header.data[0] != 0 || header.data[1] > 1) {
        throw std::runtime_error("it is not plain CDR (its header is " +
                                 std::to_string(header.data[0]) + " " +
                                 std::to_string(header.data[1]) + ")");
    }
    reader.start_ = 4;
    reader.is_cdr_ = true;
    reader.swaps_ = header.data[1] == 0;
    return reader;
}

}  // namespace hagen::recordings
