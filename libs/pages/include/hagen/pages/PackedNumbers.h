#pragma once
#include <cstdint>
#include <string>
#include <vector>

namespace hagen::pages {

/// Whole numbers of 16 bits, little-endian, as pages carry them: in base64.
class PackedNumbers {
 public:
    /// Rounded; what is beyond 16 bits becomes the nearest that is not.
    void add(double value);
    std::string text() const;

 private:
    std::vector<std::uint8_t> bytes_;
};

}  // namespace hagen::pages
