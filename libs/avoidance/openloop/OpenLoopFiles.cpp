#include "avoidance/openloop/OpenLoopFiles.h"

#include <iomanip>
#include <locale>
#include "base/Json.h"
#include "base/WriteFile.h"
#include "evaluation/Latency.h"

namespace hagen::avoidance {
namespace {

namespace fs = std::filesystem;
using base::Json;

/// Fixed decimals; NaN is an empty field.
struct Fixed {
    double value;
    int decimals;
};
std::ostream& operator<<(std::ostream& out, const Fixed& number) {
    if (std::isnan(number.value)) return out;
    return out << std::fixed << std::setprecision(number.decimals) << number.value;
}

double median(const std::vector<double>& values) { return evaluation::latencyOf(values).p50_ms; }
double most(const std::vector<double>& values) { return evaluation::latencyOf(values).max_ms; }

void writeCounts(std::ostream& out, const DirectionCounts& counts) {
    out << "," << counts.scored << "," << counts.hits << "," << counts.false_alarms << ","
        << counts.misses;
}

void writeModels(std::ostream& out, const OpenLoopResult& result) {
    out << "model,scans,obstacles,bytes,most_bytes,blocked,precision,recall,level_precision,"
           "level_recall,scored,hits,false_alarms,misses,level_scored,level_hits,"
           "level_false_alarms,level_misses\n";
    for (const OpenLoopModel& model : result.models) {
        out << model.name << "," << result.scans << "," << Fixed{median(model.obstacles), 0} << ","
            << Fixed{median(model.bytes), 0} << "," << Fixed{most(model.bytes), 0} << ","
            << Fixed{median(model.blocked), 0} << "," << Fixed{model.all.precision(), 4} << ","
            << Fixed{model.all.recall(), 4} << "," << Fixed{model.level.precision(), 4} << ","
            << Fixed{model.level.recall(), 4};
        writeCounts(out, model.all);
        writeCounts(out, model.level);
        out << "\n";
    }
}

void writeLatency(std::ostream& out, const std::vector<double>& runs_ms) {
    const evaluation::Latency latency = evaluation::latencyOf(runs_ms);
    out << "," << Fixed{latency.p50_ms, 3} << "," << Fixed{latency.p95_ms, 3} << ","
        << Fixed{latency.max_ms, 3};
}

void writeModelsMeasured(std::ostream& out, const OpenLoopResult& result) {
    out << "model,filter_p50_ms,filter_p95_ms,filter_max_ms,update_p50_ms,update_p95_ms,"
           "update_max_ms,queries_p50_ms,queries_p95_ms,queries_max_ms,peak_heap_bytes\n";
    for (const OpenLoopModel& model : result.models) {
        out << model.name;
        writeLatency(out, result.filter_ms);
        writeLatency(out, model.update_ms);
        writeLatency(out, model.queries_ms);
        out << "," << Fixed{model.peak_heap_bytes, 0} << "\n";
    }
}

void writeAgreement(std::ostream& out, const OpenLoopResult& result) {
    out << "model,other,free_jaccard\n";
    for (std::size_t a = 0; a < result.models.size(); ++a) {
        for (std::size_t b = a + 1; b < result.models.size(); ++b) {
            out << result.models[a].name << "," << result.models[b].name << ","
                << Fixed{result.agreement[a][b], 4} << "\n";
        }
    }
}

enum Name { Models, Scans, Agreement, Summary, ModelsMeasured, ScansMeasured };
constexpr const char* kNames[] = {"openloop.csv",          "scans.csv",
                                  "agreement.csv",         "summary.json",
                                  "openloop_measured.csv", "scans_measured.csv"};

Json number(double value) { return std::isnan(value) ? Json() : Json(value); }

Json json(const DirectionCounts& counts) {
    return {{"scored", counts.scored},
            {"hits", counts.hits},
            {"false_alarms", counts.false_alarms},
            {"misses", counts.misses},
            {"precision", number(counts.precision())},
            {"recall", number(counts.recall())}};
}

Json json(const std::vector<double>& runs_ms) {
    const evaluation::Latency latency = evaluation::latencyOf(runs_ms);
    return {{"p50", number(latency.p50_ms)},
            {"p95", number(latency.p95_ms)},
            {"max", number(latency.max_ms)}};
}

Json json(const OpenLoopModel& model) {
    Json by_elevation = Json::array();
    for (std::size_t e = 0; e < kDirectionElevations; ++e) {
        Json counts = json(model.by_elevation[e]);
        counts["elevation_rad"] =
            std::round(1e4 * elevationOfDirection(e * kDirectionAzimuths)) / 1e4;
        by_elevation.push_back(counts);
    }
    return {
        {"name", model.name},
        {"obstacles", number(median(model.obstacles))},
        {"bytes", number(median(model.bytes))},
        {"most_bytes", number(most(model.bytes))},
        {"blocked", number(median(model.blocked))},
        {"directions",
         {{"all", json(model.all)}, {"level", json(model.level)}, {"by_elevation", by_elevation}}}};
}

Json summaryOf(const OpenLoop& open_loop, const OpenLoopResult& result) {
    Json report{{"hagen", HAGEN_VERSION},
                {"log", open_loop.source.log.string()},
                {"poses", result.poses},
                {"truth", truthOf(open_loop)},
                {"scans", result.scans},
                {"scans_without_pose", result.scans_without_pose},
                {"unreadable_scans", result.unreadable_scans},
                {"remarks", result.remarks},
                {"scans_moved_whole", result.scans_placed_by_one_pose},
                {"maps_begun_anew", result.model_resets},
                {"returns", number(median(result.returns))},
                {"roi", number(median(result.roi))}};
    Json names = Json::array(), measured = Json::array();
    report["models"] = Json::array();
    for (const OpenLoopModel& model : result.models) {
        report["models"].push_back(json(model));
        names.push_back(model.name);
        measured.push_back({{"name", model.name},
                            {"update_ms", json(model.update_ms)},
                            {"queries_ms", json(model.queries_ms)},
                            {"peak_heap_bytes", model.peak_heap_bytes}});
    }
    report["free_agreement"] = {{"models", names}, {"jaccard", result.agreement}};
    report["measured"] = {{"filter_ms", json(result.filter_ms)}, {"models", measured}};
    return report;
}

}  // namespace

std::string truthOf(const OpenLoop& open_loop) {
    if (!open_loop.scene) return "raw points of later scans";
    return "the scene " + open_loop.scene->scenario + " with seed " +
           std::to_string(open_loop.scene->seed);
}

OpenLoopFiles::OpenLoopFiles(const fs::path& folder, bool overwrite,
                             const std::vector<fs::path>& inputs)
    : folder_(folder), is_own_folder_(!fs::exists(folder)) {
    std::vector<fs::path> outputs;
    for (const char* name : kNames) outputs.push_back(folder / name);
    base::checkApart(outputs, inputs);
    fs::create_directories(folder);
    for (const fs::path& output : outputs) {
        File& file = *files_.emplace_back(std::make_unique<File>(output, overwrite));
        all_.add(file.path);
        file.out = base::openToWrite(file.path.temporary(), output);
        file.out.imbue(std::locale::classic());
    }
    files_[Scans]->out << "scan,entry,time_s,model,returns,roi,obstacles,bytes,blocked,"
                          "truly_blocked,scored,hits,false_alarms,misses,level_scored,level_hits,"
                          "level_false_alarms,level_misses\n";
    files_[ScansMeasured]->out << "scan,model,filter_ms,update_ms,queries_ms,heap_bytes\n";
}

OpenLoopFiles::~OpenLoopFiles() {
    files_.clear();  // removes temporary files
    std::error_code ignored;
    if (is_own_folder_) fs::remove(folder_, ignored);  // succeeds only if empty
}

std::vector<fs::path> OpenLoopFiles::paths() const {
    std::vector<fs::path> paths;
    for (const auto& file : files_) paths.push_back(file->path.path());
    return paths;
}

void OpenLoopFiles::add(const OpenLoopRow& row, const OpenLoopCost& cost) {
    std::ostream& out = files_[Scans]->out;
    out << row.scan << "," << row.entry << "," << Fixed{row.time_s, 6} << "," << row.model << ","
        << row.returns << "," << row.roi << "," << row.obstacles << "," << row.bytes << ","
        << row.blocked << "," << row.truly_blocked;
    writeCounts(out, row.all);
    writeCounts(out, row.level);
    out << "\n";
    files_[ScansMeasured]->out << row.scan << "," << row.model << "," << Fixed{cost.filter_ms, 3}
                               << "," << Fixed{cost.update_ms, 3} << ","
                               << Fixed{cost.queries_ms, 3} << "," << Fixed{cost.heap_bytes, 0}
                               << "\n";
    for (const Name name : {Scans, ScansMeasured}) {
        File& file = *files_[name];
        all_.write(file.path, [&] {
            if (!file.out) base::closeWritten(file.out, file.path.path());  // throws
        });
    }
}

void OpenLoopFiles::finish(const OpenLoop& open_loop, const OpenLoopResult& result) {
    writeModels(files_[Models]->out, result);
    writeModelsMeasured(files_[ModelsMeasured]->out, result);
    writeAgreement(files_[Agreement]->out, result);
    files_[Summary]->out << base::dumpJson(summaryOf(open_loop, result), 2) << "\n";
    for (const auto& file : files_) {
        all_.write(file->path, [&] { base::closeWritten(file->out, file->path.path()); });
    }
}

void OpenLoopFiles::commit(const OpenLoop& open_loop, const OpenLoopResult& result) {
    finish(open_loop, result);
    all_.commit();
    for (const auto& file : files_) {
        for (const fs::path& part : base::partialOutputs(file->path.path())) fs::remove(part);
    }
}

std::string OpenLoopFiles::keepPartial(const OpenLoop& open_loop, const OpenLoopResult& result) {
    finish(open_loop, result);
    for (const auto& file : files_) all_.write(file->path, [&] { file->path.keepPartial(); });
    return all_.failures();
}

}  // namespace hagen::avoidance
