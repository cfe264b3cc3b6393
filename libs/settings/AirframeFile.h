#pragma once
#include <hagen/scan/Image.h>
#include <filesystem>
#include <string>

namespace hagen {

/// Reads a file of learned bins into Airframe::bin_range_m:
///
///     bin_deg: 2               # [deg] divides 180; 0.5 ... 30
///     bins:                    # azimuth and elevation of a bin's lower edges [deg], its range [m]
///     - [-180, -16, 0.531]
///
/// Bins start at multiples of bin_deg; bins missing from the file have range 0. Throws
/// SettingsError naming the file, line, key and allowed values.
Image<float> readAirframeBins(const std::filesystem::path& file);

/// Returns the bins in this file format, with a comment that names their `origin`.
std::string airframeBinsText(const Image<float>& bin_range_m, const std::string& origin);

}  // namespace hagen
