#include "TimedRows.h"

#include <cmath>
#include <fstream>
#include <iomanip>
#include <nlohmann/json.hpp>
#include <sstream>
#include <stdexcept>

#include "support/Tables.h"

namespace hagen {

const TimedRow* find(const std::vector<TimedRow>& rows, const std::string& sensor,
                     const std::string& what) {
    for (const TimedRow& row : rows) {
        if (row.sensor == sensor && row.what == what) return &row;
    }
    return nullptr;
}

std::string tableOf(const std::vector<TimedRow>& rows) {
    std::ostringstream text;
    text << std::fixed << std::setprecision(1);
    std::string sensor;
    for (const TimedRow& row : rows) {
        if (row.sensor != sensor) {
            text << (sensor.empty() ? "" : "\n") << std::left << std::setw(31)
                 << row.sensor + ", microseconds" << std::right
                 << "    p50    p95    p99 cold50 cold95 cold99 alloc\n";
            sensor = row.sensor;
        }
        text << std::left << std::setw(31) << row.what << std::right;
        for (const evaluation::Latency& t : {row.warm, row.cold}) {
            for (const double ms : {t.p50_ms, t.p95_ms, t.p99_ms}) {
                text << std::setw(7) << cell(1e3 * ms, 0);
            }
        }
        text << std::setw(6) << row.allocations << "\n";
    }
    return text.str();
}

namespace {

nlohmann::ordered_json toJson(const evaluation::Latency& t) {
    return {{"runs", t.runs}, {"p50_ms", t.p50_ms}, {"p95_ms", t.p95_ms}, {"p99_ms", t.p99_ms}};
}

evaluation::Latency latencyFrom(const nlohmann::json& json) {
    evaluation::Latency t;
    t.runs = json.at("runs");
    if (t.runs == 0) return t;  // JSON has no NaN
    t.p50_ms = json.at("p50_ms");
    t.p95_ms = json.at("p95_ms");
    t.p99_ms = json.at("p99_ms");
    return t;
}

}  // namespace

std::string jsonOf(const std::vector<TimedRow>& rows) {
    nlohmann::ordered_json list = nlohmann::ordered_json::array();
    for (const TimedRow& row : rows) {
        list.push_back({{"sensor", row.sensor},
                        {"what", row.what},
                        {"pixels", row.pixels},
                        {"allocations", row.allocations},
                        {"warm", toJson(row.warm)},
                        {"cold", toJson(row.cold)}});
    }
    return list.dump(1) + "\n";
}

std::vector<TimedRow> readTimedRows(const std::filesystem::path& file) {
    std::ifstream in(file);
    std::vector<TimedRow> rows;
    try {
        for (const auto& json : nlohmann::json::parse(in)) {
            rows.push_back({json.at("sensor"), json.at("what"), json.at("pixels"),
                            latencyFrom(json.at("warm")), latencyFrom(json.at("cold")),
                            json.at("allocations")});
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
