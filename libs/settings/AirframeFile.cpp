#include "settings/AirframeFile.h"

#include <hagen/settings/Settings.h>
#include "base/NumberText.h"

#include "settings/YamlParts.h"

namespace hagen {
namespace {

namespace fs = std::filesystem;
constexpr double kMinBin_deg = 0.5, kMaxBin_deg = 30, kMaxBinRange_m = 20;

/// Parses an angle at which a bin starts; returns the index of the bin.
int parseStart(const YAML::Node& node, const std::string& key, double min_deg, double bin_deg,
               int bins) {
    const auto start_deg = parseNumber<double>(node, key, min_deg, -min_deg);
    const double number = (start_deg - min_deg) / bin_deg;
    if (std::abs(number - std::round(number)) > 1e-3 || std::lround(number) >= bins) {
        throw SettingsError(key + " is " + node.Scalar() + ", but must be a multiple of bin_deg (" +
                            base::shortestText(bin_deg) + ") below " +
                            base::shortestText(-min_deg));
    }
    return static_cast<int>(std::lround(number));
}

void parseBin(const YAML::Node& bin, double bin_deg, Image<float>& bin_range_m) {
    if (!bin.IsSequence() || bin.size() != 3) {
        throw SettingsError("each of bins must be [azimuth_deg, elevation_deg, range_m]");
    }
    const auto rows = static_cast<int>(bin_range_m.rows());
    const int column = parseStart(bin[0], "azimuth_deg of a bin", -180, bin_deg, 2 * rows);
    const int row = parseStart(bin[1], "elevation_deg of a bin", -90, bin_deg, rows);
    if (bin_range_m(row, column) > 0) throw SettingsError("this bin occurs twice");
    bin_range_m(row, column) = parseNumber<float>(bin[2], "range_m of a bin", 0, kMaxBinRange_m);
}

}  // namespace

Image<float> readAirframeBins(const fs::path& file) {
    const YAML::Node document = parseFile(file);
    if (!document.IsMap() || !document["bin_deg"] || !document["bins"]) {
        throw SettingsError(file.string() +
                            ": not a learned airframe: expected bin_deg and bins; "
                            "'rawlog-segment --learn-airframe' writes such files");
    }
    forEachKey(file, document, "", "", [&](const auto& key, const auto&, const auto& place) {
        if (key != "bin_deg" && key != "bins") {
            throw SettingsError(place + unknownKey(key, {"bin_deg", "bins"}));
        }
    });
    const YAML::Node size = document["bin_deg"], bins = document["bins"];
    double bin_deg = 0;
    try {
        bin_deg = parseNumber<double>(size, "bin_deg", kMinBin_deg, kMaxBin_deg);
        const double rows = 180 / bin_deg;
        if (std::abs(rows - std::round(rows)) > 1e-6) {
            throw SettingsError("bin_deg is " + size.Scalar() + ", but must divide 180");
        }
        if (!bins.IsSequence()) throw SettingsError("bins must be a list");
    } catch (const SettingsError& e) {
        throw SettingsError(at(file, size) + e.what());
    }
    const auto rows = static_cast<Eigen::Index>(std::lround(180 / bin_deg));
    Image<float> bin_range_m = Image<float>::Zero(rows, 2 * rows);
    for (const YAML::Node& bin : bins) {
        try {
            parseBin(bin, bin_deg, bin_range_m);
        } catch (const SettingsError& e) {
            throw SettingsError(at(file, bin) + e.what());
        }
    }
    return bin_range_m;
}

std::string airframeBinsText(const Image<float>& bin_range_m, const std::string& origin) {
    std::string comment = origin;  // file names may contain control characters
    for (char& c : comment) {
        if (static_cast<unsigned char>(c) < 0x20) c = ' ';
    }
    const double bin_deg = 180.0 / static_cast<double>(bin_range_m.rows());
    std::string text = "# The airframe in the sensor frame, learned from " + comment +
                       ".\n# Use it with 'airframe: [{learned: THIS FILE}]' in a settings file."
                       "\nbin_deg: " +
                       base::shortestText(bin_deg) + "\n";
    std::string bins;
    for (Eigen::Index column = 0; column < bin_range_m.cols(); ++column) {
        for (Eigen::Index row = 0; row < bin_range_m.rows(); ++row) {
            if (!(bin_range_m(row, column) > 0)) continue;
            bins += "- [" + base::shortestText(-180 + bin_deg * static_cast<double>(column)) +
                    ", " + base::shortestText(-90 + bin_deg * static_cast<double>(row)) + ", " +
                    base::fixedText(static_cast<double>(bin_range_m(row, column)), 3) + "]\n";
        }
    }
    return text + (bins.empty() ? "bins: []\n"
                                : "bins:  # start azimuth and elevation of the bin [deg], "
                                  "masked up to this range [m]\n" +
                                      bins);
}

}  // namespace hagen
