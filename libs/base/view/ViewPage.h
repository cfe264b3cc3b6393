#pragma once
#include <cstdint>
#include <ostream>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>
#include "base/Json.h"

namespace hagen::base {

/// Arrays of numbers of a view (docs/view.md): byte planes, deflated, as base64.
class ViewArrays {
 public:
    /// Adds an array of integers. Differences between neighbours compress better if values are
    /// similar; they wrap around.
    template <class Integer>
    void add(const std::string& name, std::vector<Integer> values, bool as_differences = false) {
        static_assert(std::is_integral_v<Integer> && sizeof(Integer) <= 4);
        using Bits = std::make_unsigned_t<Integer>;
        for (std::size_t i = values.size(); as_differences && i-- > 1;) {
            values[i] = static_cast<Integer>(
                static_cast<Bits>(static_cast<Bits>(values[i]) - static_cast<Bits>(values[i - 1])));
        }
        for (std::size_t byte = 0; byte < sizeof(Integer); ++byte) {
            for (const Integer value : values) {
                bytes_.push_back(
                    static_cast<std::uint8_t>(static_cast<Bits>(value) >> (8 * byte) & 0xffu));
            }
        }
        const std::string type =
            (std::is_signed_v<Integer> ? "i" : "u") + std::to_string(8 * sizeof(Integer));
        directory_.push_back({name, type, values.size(), as_differences});
    }

    /// {"arrays": [[name, type, count, whether differences] ...], "data": base64}. `level` is that
    /// of zlib, 1 (fast) to 9.
    Json json(int level = 5) const;

 private:
    Json directory_ = Json::array();
    std::vector<std::uint8_t> bytes_;
};

/// Returns of a scan for a view, in the sensor frame. Arrays have the same size, or are empty if
/// the quantity is unknown.
struct ViewReturns {
    std::vector<float> azimuth_rad, elevation_rad, range_m;
    std::vector<float> intensity;        ///< 0 to 1
    std::vector<std::uint8_t> label;     ///< 0 unclassified, 1 ROU, 2 RoI
    std::vector<std::int32_t> obstacle;  ///< of RoI returns; 0: none
    std::vector<std::int32_t> pixel;     ///< column * rows + row; -1: none
    int rows = 0, columns = 0;           ///< of the image of `pixel`

    /// Adds a return at this position, without pixel, obstacle and intensity.
    void add(float x_m, float y_m, float z_m, std::uint8_t new_label);
    std::size_t size() const { return range_m.size(); }
};

/// Adds the returns, rounded: azimuths to 1/8 column or 0.02 degrees, elevations to 0.03 degrees,
/// ranges to 4 cm (up to 2621 m), intensities to 16 levels.
void addReturns(const ViewReturns& returns, ViewArrays& arrays);

/// Rounds a value and limits it to the range of an integer; NaN becomes 0.
template <class Integer>
Integer roundedTo(double value);

/// Writes a self-contained HTML page that shows `data` (docs/view.md). `frames` are the JSON texts
/// of its frames. `extra_script` runs before the page's own.
void writeViewPage(std::ostream& out, const Json& data, const std::vector<std::string>& frames,
                   std::string_view extra_script = {});

}  // namespace hagen::base
