#include "TimedRows.h"

#include <cmath>
#include <cstdio>
#include <fstream>
#include <nlohmann/json.hpp>
#include <stdexcept>

namespace hagen {

const TimedRow* find(const std::vector<TimedRow>& rows, const std::string& sensor,
                     const std::string& what) {
    for (const TimedRow& row : rows) {
        if (row.sensor == sensor && row.what == what) return &row;
    }
    return nullptr;
}

std::string tableOf(const std::vector<TimedRow>& rows) {
    std::string text, sensor;
    char line[160];
    for (const TimedRow& row : rows) {
        if (row.sensor != sensor) {
            sensor = row.sensor;
            std::snprintf(line, sizeof line, "%s%-36s %10s %10s %10s %10s %12s\n",
                          text.empty() ? "" : "\n", (sensor + ", microseconds").c_str(), "median",
                          "p95", "p99", "max", "allocations");
            text += line;
        }
        const evaluation::Latency& t = row.latency;
        std::snprintf(line, sizeof line, "  %-34s %10.1f %10.1f %10.1f %10.1f %12.1f\n",
                      row.what.c_str(), 1e3 * t.p50_ms, 1e3 * t.p95_ms, 1e3 * t.p99_ms,
                      1e3 * t.max_ms, row.allocations);
        text += line;
    }
    return text;
}

std::string jsonOf(const std::vector<TimedRow>& rows) {
    nlohmann::ordered_json list = nlohmann::ordered_json::array();
    for (const TimedRow& row : rows) {
        list.push_back({{"sensor", row.sensor},
                        {"what", row.what},
                        {"median_ms", row.latency.p50_ms},
                        {"p95_ms", row.latency.p95_ms},
                        {"p99_ms", row.latency.p99_ms},
                        {"max_ms", row.latency.max_ms},
                        {"runs", row.latency.runs},
                        {"allocations", row.allocations}});
    }
    return list.dump(1) + "\n";
}

std::vector<TimedRow> readTimedRows(const std::filesystem::path& file) {
    std::ifstream in(file);
    std::vector<TimedRow> rows;
    try {
        for (const auto& json : nlohmann::json::parse(in)) {
            TimedRow row{json.at("sensor"), json.at("what"), {}, json.at("allocations")};
            row.latency.p50_ms = json.at("median_ms");
            row.latency.p95_ms = json.at("p95_ms");
            row.latency.p99_ms = json.at("p99_ms");
            row.latency.max_ms = json.at("max_ms");
            row.latency.runs = json.at("runs");
            rows.push_back(row);
        }
    } catch (const nlohmann::json::exception& e) {
        throw std::runtime_error(file.string() + ": invalid list of times: " + e.what());
    }
    return rows;
}

double exponentOf(const std::vector<double>& x, const std::vector<double>& y) {
    const auto n = static_cast<double>(x.size());
    double sx = 0, sy = 0, sxx = 0, sxy = 0;
    for (std::size_t i = 0; i < x.size(); ++i) {
        const double u = std::log(x[i]), v = std::log(y[i]);
        sx += u;
        sy += v;
        sxx += u * u;
        sxy += u * v;
    }
    return (n * sxy - sx * sy) / (n * sxx - sx * sx);
}

}  // namespace hagen
