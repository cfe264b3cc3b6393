#pragma once
#include <hagen/scan/Image.h>
#include <filesystem>
#include <string>

namespace hagen::convert {

/// Draws the bins of an Airframe (Airframe::bin_range_m, at least one row) as a PNG: azimuth
/// against elevation in the sensor frame, left of the sensor on the left, coloured by masked range;
/// unmasked bins are grey. Throws std::runtime_error like Drawing::draw().
void drawAirframe(const Image<float>& bin_range_m, const std::string& title,
                  const std::filesystem::path& file);

}  // namespace hagen::convert
