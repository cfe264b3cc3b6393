#include "live/StatsFile.h"

#include "base/Json.h"

#include <cmath>
#include <fstream>
#include <stdexcept>

namespace hagen::live {
namespace {

base::Json numberOrNull(double value) { return std::isfinite(value) ? base::Json(value) : nullptr; }

}  // namespace

void writeStats(const LiveReport& r, const LiveOptions& options, const LiveListener& listener,
                base::OutputPath& file) {
    base::Json json{{"model", options.sensor_json.empty() ? options.model : "Ouster"},
                    {"seconds", r.seconds},
                    {"packets",
                     {{"datagrams", r.datagrams},
                      {"taken", r.packets},
                      {"lost", r.lost},
                      {"late", r.late},
                      {"too_late", r.too_late},
                      {"repeated", r.duplicate},
                      {"dropped", r.dropped},
                      {"wrong_size", r.wrong_size},
                      {"position", r.auxiliary},
                      {"foreign", r.other_sensor},
                      {"unsound", r.unsound},
                      {"uncertain", r.uncertain}}},
                    {"unsound_blocks", r.unsound_blocks},
                    {"interruptions", r.interruptions},
                    {"silences", r.silences},
                    {"mode_changes", r.mode_changes},
                    {"rate_changes", r.rate_changes},
                    {"directions",
                     {{"unknown", r.times_unknown},
                      {"seen_nothing", r.times_seen_nothing},
                      {"obstacle", r.times_obstacle}}},
                    {"scans", r.scans},
                    {"sectors", r.sectors},
                    {"sectors_cut", r.sectors_cut},
                    {"sectors_doubtful", r.sectors_doubtful},
                    {"returns", r.returns},
                    {"roi", r.roi}};
    json["latency_ms"] =
        base::Json{{"p50", numberOrNull(1e3 * r.latency.quantile_s(0.5))},
                   {"p99", numberOrNull(1e3 * r.latency.quantile_s(0.99))},
                   {"p99.9", numberOrNull(1e3 * r.latency.quantile_s(0.999))},
                   {"max", r.latency.count() > 0 ? base::Json(1e3 * r.latency.max_s()) : nullptr}};
    json["cpu"] = base::Json{{"filter_share", numberOrNull(r.filter_cpu_s / r.seconds)},
                             {"process_share", numberOrNull(r.process_cpu_s / r.seconds)}};
    base::Json nearest = base::Json::array();
    for (const float distance_m : r.nearest_m) {
        nearest.push_back(numberOrNull(static_cast<double>(distance_m)));
    }
    json["nearest_m"] = nearest;
    if (!options.recording.file.empty()) {
        base::Json files = base::Json::array();
        for (const auto& name : r.recorded.files) files.push_back(name.string());
        json["recorded"] = base::Json{{"packets", r.recorded.packets},
                                      {"left_out", r.recorded.left_out},
                                      {"poses", r.recorded.poses},
                                      {"files", files},
                                      {"failure", r.recorded.failure}};
    }
    for (const auto& [name, counts] : listener.counts) {
        for (const auto& [what, number] : counts()) json[name][what] = number;
    }
    std::ofstream out(file.temporary());
    out << base::dumpJson(json, 2) << '\n';
    out.close();
    if (!out) throw std::runtime_error(file.path().string() + ": cannot be written");
    file.commit();
}

}  // namespace hagen::live
