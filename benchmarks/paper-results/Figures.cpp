#include "Figures.h"

#include "convert/pictures/Drawing.h"

#include "OperatingSection.h"
#include "Rows.h"
#include "Sums.h"

namespace hagen {
namespace {

using base::Json;

bool isDrawn(const std::string& row) {
    const bool is_tuned = row.find(" tuned") != std::string::npos;
    const bool is_varied = row.find('=') != std::string::npos;
    return !is_tuned && !is_varied;
}

/// Returns the part of a flight's folder name that identifies its scenario.
std::string scenarioOf(const std::string& folder, bool is_simulated) {
    return is_simulated ? folder.substr(0, folder.rfind('-', folder.rfind('-') - 1)) : folder;
}

/// F1 of RoI over the scans of a set; scenarios are marked below the axis.
Json scanPanel(const Measured& measured) {
    Json panel{{"title", measured.set.name}, {"y", "F1 of RoI"}, {"grid", "both"}};
    for (const evaluation::MethodScores& method : measured.methods) {
        if (!isDrawn(method.name)) continue;
        Json line{{"name", method.name}};
        for (const evaluation::ScanScores& scan : method.returns) {
            line["x"].push_back(line["x"].size());
            line["y"].push_back(scan.all.roi.f1());
        }
        panel["lines"].push_back(line);
    }
    std::string last;
    const std::vector<evaluation::ScanScores>& scans = measured.methods.front().returns;
    for (std::size_t s = 0; s < scans.size(); ++s) {
        const std::string name =
            scenarioOf(measured.folders[scans[s].folder], !measured.set.flights.empty());
        if (name == last) continue;
        last = name;
        panel["ticks"].push_back(s);
        panel["tick_names"].push_back(name);
    }
    return panel;
}

void drawScans(const std::filesystem::path& folder, const std::vector<Measured>& scores) {
    Json panels;
    for (const Measured& measured : scores) {
        const bool is_real = measured.set.flights.empty() && measured.set.has_all_rows;
        const bool is_timed_flight = measured.set.is_altitude && measured.set.is_timed;
        if ((is_real && measured.set.preset == "vlp16.yaml") || is_timed_flight) {
            panels.push_back(scanPanel(measured));
        }
    }
    convert::Drawing({{"kind", "chart"},
                      {"file", (folder / "by_scan.svg").string()},
                      {"width", 1100},
                      {"height", 360 * panels.size()},
                      {"columns", 1},
                      {"panels", panels}})
        .draw();
}

void drawTimes(const std::filesystem::path& folder, const std::vector<Measured>& times) {
    const std::vector<int> ticks{5, 10, 20, 30, 50, 70, 100, 150, 200};
    Json panel{{"title", ""},
               {"x", "returns of the scan, in thousands"},
               {"y", "run time [ms]"},
               {"log", "xy"},
               {"ls", ""},
               {"ticks", ticks}};
    for (const evaluation::MethodScores& method : times.front().methods) {
        if (!isDrawn(method.name)) continue;
        Json line{{"name", method.name}};
        for (const Measured& measured : times) {
            const std::vector<double>& latency_ms = measured.row(method.name)->latency_ms;
            for (std::size_t s = 0; s < latency_ms.size(); ++s) {
                line["x"].push_back(static_cast<double>(measured.returns[s]) / 1000);
                line["y"].push_back(latency_ms[s]);
            }
        }
        panel["lines"].push_back(line);
    }
    convert::Drawing({{"kind", "chart"},
                      {"file", (folder / "by_returns.svg").string()},
                      {"width", 1100},
                      {"height", 480},
                      {"panels", Json::array({panel})}})
        .draw();
}

void drawCurves(const std::filesystem::path& folder, const std::vector<Measured>& scores) {
    Json panels = Json::array();
    for (const Measured* set : those(scores, [](const DataSet& s) { return s.flights.empty(); })) {
        Json panel{{"title", set->set.name},
                   {"x", "recall of RoI"},
                   {"y", "precision of RoI"},
                   {"grid", "both"},
                   {"ticks", {0.75, 0.8, 0.85, 0.9, 0.95, 1}}};
        for (const std::string& method : operatingMethods(*set)) {
            const evaluation::ClassScore roi = sumOf({set}, method).roi;
            Json line{{"name", method}, {"mark", {roi.recall(), roi.precision()}}};
            for (const OperatingPoint& point : operatingCurve(*set, method)) {
                line["x"].push_back(point.recall);
                line["y"].push_back(point.precision);
            }
            panel["lines"].push_back(line);
        }
        panels.push_back(panel);
    }
    if (panels.empty()) return;
    convert::Drawing({{"kind", "chart"},
                      {"file", (folder / "operating_curve.svg").string()},
                      {"width", 1100},
                      {"height", 800},
                      {"columns", 2},
                      {"panels", panels}})
        .draw();
}

}  // namespace

void drawResults(const std::filesystem::path& folder, const std::vector<Measured>& scores,
                 const std::vector<Measured>& times) {
    drawScans(folder, scores);
    drawTimes(folder, times);
    drawCurves(folder, scores);
}

}  // namespace hagen
