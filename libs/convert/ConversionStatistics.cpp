#include "convert/ConversionStatistics.h"
#include "base/Json.h"
#include "base/Quantile.h"
#include "settings/SettingsJson.h"

#include <algorithm>
#include <cmath>

#include "base/WriteFile.h"

namespace hagen::convert {
namespace {

using base::Json;

Json recoveredOf(const ConversionReport& report) {
    Json sensors = Json::object();
    for (const auto& [label, recovered] : report.recovered) {
        const SensorModel& sensor = recovered.beams->sensor;
        sensors[label] = {{"name", sensor.name},
                          {"beams", sensor.rows()},
                          {"beams_seen", recovered.beams->seen_rad.size()},
                          {"share", std::round(1e4 * recovered.beams->share) / 1e4},
                          {"has_rings", sensor.has_rings},
                          {"columns", recovered.columns}};
    }
    return sensors;
}

Json latencyOf(const std::vector<ScanReport>& scans) {
    if (scans.empty()) return nullptr;
    std::vector<double> latencies_ms;
    for (const ScanReport& scan : scans) latencies_ms.push_back(scan.latency_ms);
    std::sort(latencies_ms.begin(), latencies_ms.end());
    return {{"scans", scans.size()},
            {"p50", base::nearestRankOfSorted(latencies_ms, 0.50)},
            {"p95", base::nearestRankOfSorted(latencies_ms, 0.95)},
            {"p99", base::nearestRankOfSorted(latencies_ms, 0.99)},
            {"max", latencies_ms.back()}};
}

double inMillimetres(float metres) {
    return std::round(static_cast<double>(metres) * 1e3) / 1e3;  // rounds to the sensor resolution
}

Json lineOf(const ScanReport& scan) {
    const bool has_roi = !std::isnan(scan.nearest_roi_m);
    return {{"scan", scan.entry},
            {"sensor", scan.sensor_label},
            {"name", scan.name},
            {"time_s", scan.time_s},
            {"returns", scan.returns},
            {"roi", scan.roi},
            {"rou", scan.rou},
            {"unclassified", scan.unclassified},
            {"returns_masked", scan.returns_masked},
            {"obstacles", scan.obstacles},
            {"nearest_roi_m", has_roi ? Json(inMillimetres(scan.nearest_roi_m)) : Json()},
            {"latency_ms", scan.latency_ms}};
}

}  // namespace

void printConversionStatistics(std::ostream& out, const Conversion& conversion,
                               const ConversionReport& report) {
    Json json{{"hagen", HAGEN_VERSION}, {"input", conversion.input.string()}};
    for (const auto& [what, path] : {std::pair{"rawlog", conversion.rawlog},
                                     {"folder", conversion.folder},
                                     {"clouds", conversion.clouds},
                                     {"mcap", conversion.mcap},
                                     {"pictures", conversion.pictures}}) {
        if (!path.empty()) json["outputs"][what] = path.string();
    }
    for (const auto& path : conversion.octomaps)
        json["outputs"]["octomaps"].push_back(path.string());
    json["settings"] = jsonOf(report.settings);
    json["sensors"] = report.sensors;
    json["recovered_sensors"] = recoveredOf(report);
    json["poses"] = {{"source", report.poses}, {"scans_with_pose", report.scans_with_pose}};
    if (!conversion.octomaps.empty()) json["scans_in_map"] = report.scans_in_map;
    if (!conversion.clouds.empty()) {
        json["clouds"] = {{"files", report.clouds}, {"points", report.cloud_points}};
    }
    if (!conversion.mcap.empty()) {
        json["mcap"] = {{"scans", report.mcap.scans},
                        {"points", report.mcap.points},
                        {"boxes", report.mcap.boxes},
                        {"messages", report.mcap.messages}};
    }
    json["entries"] = report.entries;
    json["unreadable_scans"] = report.unreadable_scans;
    json["results_replaced"] = report.results_replaced;
    json["left_out_before"] = report.left_out_before;
    json["returns"] = {{"all", report.returns},
                       {"roi", report.roi},
                       {"rou", report.rou},
                       {"unclassified", report.unclassified}};
    json["returns_masked"] = report.returns_masked;
    json["latency_ms"] = latencyOf(report.scan_reports);

    // Scans are written one by one, because a single JSON value would take about 1 kB of memory per
    // scan.
    const std::string head = base::dumpJson(json, 1);
    out << head.substr(0, head.rfind("\n}")) << ",\n \"scans\": [";
    for (std::size_t i = 0; i < report.scan_reports.size(); ++i) {
        out << (i == 0 ? "\n  " : ",\n  ") << base::dumpJson(lineOf(report.scan_reports[i]));
    }
    out << "]\n}\n";
}

void writeConversionStatistics(const std::filesystem::path& file, const Conversion& conversion,
                               const ConversionReport& report) {
    std::ofstream out(file);
    printConversionStatistics(out, conversion, report);
    base::closeWritten(out, file);
}

}  // namespace hagen::convert
