#include "ConversionTimes.h"

#include <fstream>
#include <nlohmann/json.hpp>
#include <stdexcept>

namespace hagen {

void appendTo(const std::filesystem::path& json_lines, const ConversionTimes& t) {
    const nlohmann::ordered_json json{{"settings", t.settings},
                                      {"scans", t.scans},
                                      {"jobs", t.jobs},
                                      {"flight_s", t.flight_s},
                                      {"conversion_s", t.conversion_s},
                                      {"cpu_ms", t.cpu_ms},
                                      {"reading_ms", t.reading_ms},
                                      {"packets_to_labels_ms", t.packets_to_labels_ms},
                                      {"peak_megabytes", t.peak_megabytes}};
    std::ofstream out(json_lines, std::ios::app);
    out << json.dump() << "\n";
    out.close();
    if (!out) throw std::runtime_error(json_lines.string() + ": cannot be written");
}

std::vector<ConversionTimes> readConversionTimes(const std::filesystem::path& json_lines) {
    std::ifstream in(json_lines);
    std::vector<ConversionTimes> all;
    try {
        for (std::string line; std::getline(in, line);) {
            const auto json = nlohmann::json::parse(line);
            ConversionTimes t;
            t.settings = json.at("settings");
            t.scans = json.at("scans");
            t.jobs = json.at("jobs");
            t.flight_s = json.at("flight_s");
            t.conversion_s = json.at("conversion_s");
            t.cpu_ms = json.at("cpu_ms");
            t.reading_ms = json.at("reading_ms");
            t.packets_to_labels_ms = json.at("packets_to_labels_ms");
            t.peak_megabytes = json.at("peak_megabytes");
            all.push_back(t);
        }
    } catch (const nlohmann::json::exception& e) {
        throw std::runtime_error(json_lines.string() + ": invalid conversion times: " + e.what());
    }
    return all;
}

}  // namespace hagen
