#include "Samples.h"

#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>

namespace hagen {

const Measured* find(const std::vector<Measured>& rows, const std::string& sensor,
                     const std::string& what) {
    for (const Measured& row : rows) {
        if (row.sensor == sensor && row.what == what) return &row;
    }
    return nullptr;
}

std::string tableOf(const std::vector<Measured>& rows) {
    std::string text, sensor;
    char line[160];
    for (const Measured& row : rows) {
        if (row.sensor != sensor) {
            sensor = row.sensor;
            std::snprintf(line, sizeof line, "%s%-36s %10s %10s %10s %10s %12s\n",
                          text.empty() ? "" : "\n", (sensor + ", microseconds").c_str(), "median",
                          "p95", "p99", "max", "allocations");
            text += line;
        }
        const Latency t = row.latency();
        std::snprintf(line, sizeof line, "  %-34s %10.1f %10.1f %10.1f %10.1f %12.1f\n",
                      row.what.c_str(), 1e3 * t.p50_ms, 1e3 * t.p95_ms, 1e3 * t.p99_ms,
                      1e3 * t.max_ms, row.allocationsARun());
        text += line;
    }
    return text;
}

std::string jsonOf(const std::vector<Measured>& rows) {
    nlohmann::ordered_json list = nlohmann::ordered_json::array();
    for (const Measured& row : rows) {
        const Latency t = row.latency();
        list.push_back({{"sensor", row.sensor},
                        {"what", row.what},
                        {"median_ms", t.p50_ms},
                        {"p95_ms", t.p95_ms},
                        {"p99_ms", t.p99_ms},
                        {"max_ms", t.max_ms},
                        {"runs", t.runs},
                        {"allocations", row.allocationsARun()}});
    }
    return list.dump(1) + "\n";
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
