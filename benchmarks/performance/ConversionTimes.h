// Results of conversion-benchmark as lines of JSON.
#pragma once
#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

namespace hagen {

/// Median times of a conversion. CPU times include the process that reads ahead.
struct ConversionTimes {
    std::string settings;
    std::size_t scans = 0, jobs = 0;
    double flight_s = 0;
    double conversion_s = 0;
    double cpu_ms = 0, reading_ms = 0;  ///< CPU time per scan: in total, and of reading the log
    double packets_to_labels_ms = 0;    ///< per scan
    double peak_megabytes = 0;
};

/// Both throw std::runtime_error, naming the file.
void appendTo(const std::filesystem::path& json_lines, const ConversionTimes& times);
std::vector<ConversionTimes> readConversionTimes(const std::filesystem::path& json_lines);

}  // namespace hagen
