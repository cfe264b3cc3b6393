#include "ConversionTimes.h"

#include <fstream>
#include <nlohmann/json.hpp>
#include <stdexcept>

namespace hagen {

void appendTo(const std::filesystem::path& json_lines, const ConversionTimes& t) {
    nlohmann::ordered_json json{{"settings", t.settings},
                                {"scans", t.scans},
                                {"jobs", t.jobs},
                                {"flight_s", t.flight_s},
                                {"conversion_s", t.conversion_s},
                                {"conversion_processor_s", t.conversion_processor_s},
                                {"packets_to_labels_s", t.packets_to_labels_s},
                                {"peak_megabytes", t.peak_megabytes}};
    if (!std::isnan(t.copy_s)) {
        json["copy_s"] = t.copy_s;
        json["copy_processor_s"] = t.copy_processor_s;
    }
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
            t.conversion_processor_s = json.at("conversion_processor_s");
            t.packets_to_labels_s = json.at("packets_to_labels_s");
            t.peak_megabytes = json.at("peak_megabytes");
            t.copy_s = json.value("copy_s", t.copy_s);
            t.copy_processor_s = json.value("copy_processor_s", t.copy_processor_s);
            all.push_back(t);
        }
    } catch (const nlohmann::json::exception& e) {
        throw std::runtime_error(json_lines.string() + ": invalid conversion times: " + e.what());
    }
    return all;
}

}  // namespace hagen
