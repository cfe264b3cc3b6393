#include <hagen/avoidance/LatencyProfile.h>
#include <algorithm>
#include <cmath>
#include <iterator>
#include <stdexcept>
#include <utility>
#include "base/Json.h"
#include "base/Quantile.h"
#include "base/ReadFile.h"
#include "base/TextStream.h"

namespace hagen::avoidance {
namespace {

using base::Json;

double toMicroseconds(double latency_ms) { return std::round(1e3 * latency_ms) / 1e3; }

std::vector<double> quantilesFrom(const nlohmann::json& value) {
    constexpr double kMax_ms = 60000;  // longer latencies would stall flights
    const std::string rule = "must be one or more numbers from 0 to 60000 [ms] in ascending order";
    if (!value.is_array() || value.empty()) throw std::runtime_error(rule);
    std::vector<double> quantiles;
    for (const nlohmann::json& entry : value) {
        if (!entry.is_number()) throw std::runtime_error(rule);
        quantiles.push_back(toMicroseconds(entry.get<double>()));
    }
    const bool are_latencies = std::all_of(quantiles.begin(), quantiles.end(),
                                           [](double q) { return q >= 0 && q <= kMax_ms; });
    if (!are_latencies || !std::is_sorted(quantiles.begin(), quantiles.end())) {
        throw std::runtime_error(rule);
    }
    return quantiles;
}

LatencyProfile profileFrom(const nlohmann::json& root) {
    const auto by_stage = root.find("quantiles_ms");
    if (by_stage == root.end() || !by_stage->is_object()) {
        throw std::runtime_error(
            "has no key 'quantiles_ms'; expected a file written by "
            "`octomap-compare calibrate`");
    }
    LatencyProfile profile;
    for (const auto& [key, text] : {std::pair{"machine", &profile.machine},
                                    {"made_by", &profile.made_by},
                                    {"date", &profile.date}}) {
        const auto value = root.find(key);
        if (value == root.end()) continue;
        if (!value->is_string()) throw std::runtime_error(std::string(key) + ": must be a string");
        *text = *value;
    }
    for (const auto& [stage, value] : by_stage->items()) {
        try {
            profile.quantiles_ms[stage] = quantilesFrom(value);
        } catch (const std::runtime_error& e) {
            throw std::runtime_error("quantiles_ms: " + stage + ": " + e.what());
        }
    }
    return profile;
}

}  // namespace

std::string textOf(const LatencyProfile& profile) {
    base::TextStream text;
    text << "{\n  \"machine\": " << Json(profile.machine).dump()
         << ",\n  \"made_by\": " << Json(profile.made_by).dump()
         << ",\n  \"date\": " << Json(profile.date).dump() << ",\n  \"quantiles_ms\": {";
    const char* before = "\n";
    for (const auto& [stage, quantiles] : profile.quantiles_ms) {
        text << before << "    " << Json(stage).dump() << ": [";
        for (std::size_t q = 0; q < quantiles.size(); ++q) {
            text << (q > 0 ? ", " : "") << Json(toMicroseconds(quantiles[q])).dump();
        }
        text << "]";
        before = ",\n";
    }
    text << "\n  }\n}\n";
    return text.str();
}

double LatencyProfile::at_ms(const std::string& stage, double share) const {
    const auto found = quantiles_ms.find(stage);
    if (found == quantiles_ms.end() || found->second.empty()) {
        throw std::runtime_error("the latency profile has no stage \"" + stage +
                                 "\"; `octomap-compare calibrate` measures all of them");
    }
    return base::quantile(found->second, share);
}

double LatencyProfile::draw_ms(const std::string& stage, simulation::Random& random) const {
    return at_ms(stage, random.uniform());
}

double LatencyProfile::median_ms(const std::string& stage) const { return at_ms(stage, 0.5); }

std::vector<double> quantilesOf(const std::vector<double>& measured_ms, int count) {
    std::vector<double> quantiles;
    for (int q = 0; q < count && !measured_ms.empty(); ++q) {
        quantiles.push_back(base::quantile(measured_ms, static_cast<double>(q) / (count - 1)));
    }
    return quantiles;
}

LatencyProfile latencyProfileFrom(const std::string& text) {
    return profileFrom(base::parseJson(text));
}

LatencyProfile readLatencyProfile(const std::filesystem::path& file) {
    const std::string text = base::readText(file);
    try {
        return latencyProfileFrom(text);
    } catch (const std::runtime_error& e) {
        throw std::runtime_error(file.string() + ": " + e.what());
    }
}

}  // namespace hagen::avoidance
