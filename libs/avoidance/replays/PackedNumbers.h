#pragma once
#include <cstdint>
#include <string>
#include <vector>

namespace hagen::avoidance {

/// 16-bit integers, little-endian, embedded in pages as base64.
class PackedNumbers {
 public:
    /// Rounds the value and clamps it to 16 bits.
    void add(double value);
    std::string text() const;

 private:
    std::vector<std::uint8_t> bytes_;
};

}  // namespace hagen::avoidance
