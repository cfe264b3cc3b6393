// Results of conversion-benchmark as lines of JSON.
#pragma once
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

namespace hagen {

/// Median times of a conversion, and of copying the same bytes (NaN if not measured).
struct ConversionTimes {
    std::string settings;
    std::size_t scans = 0, jobs = 0;
    double flight_s = 0;
    double conversion_s = 0, conversion_processor_s = 0;
    double packets_to_labels_s = 0;  ///< part of the conversion, summed over jobs
    double copy_s = NAN, copy_processor_s = NAN;
    double peak_megabytes = 0;
};

/// Both throw std::runtime_error, naming the file.
void appendTo(const std::filesystem::path& json_lines, const ConversionTimes& times);
std::vector<ConversionTimes> readConversionTimes(const std::filesystem::path& json_lines);

}  // namespace hagen
