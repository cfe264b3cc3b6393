#include "avoidance/openloop/OpenLoopFiles.h"
#include "base/NumberText.h"
#include "base/TextStream.h"

#include <algorithm>
#include <iomanip>
#include "evaluation/Latency.h"

namespace hagen::avoidance {
namespace {

std::string cell(double value, int decimals, int width) {
    base::TextStream text;
    if (std::isnan(value)) {
        text << std::setw(width) << "-";
    } else {
        text << std::setw(width) << std::fixed << std::setprecision(decimals) << value;
    }
    return text.str();
}

int nameWidth(const OpenLoopResult& result) {
    std::size_t width = 11;
    for (const OpenLoopModel& model : result.models) {
        width = std::max(width, displayName(model.name).size());
    }
    return static_cast<int>(width) + 1;
}

void addModels(std::ostream& out, const OpenLoopResult& result) {
    const int width = nameWidth(result);
    out << std::left << std::setw(width) << "" << std::right << std::setw(24) << "update [ms]"
        << std::setw(9) << "queries" << std::setw(9) << "heap" << std::setw(10) << ""
        << std::setw(18) << "all directions" << std::setw(18) << "level and up"
        << "\n";
    out << std::left << std::setw(width) << "world model" << std::right << std::setw(8) << "p50"
        << std::setw(8) << "p95" << std::setw(8) << "max" << std::setw(9) << "p50 [ms]"
        << std::setw(9) << "[MB]" << std::setw(10) << "obstacles" << std::setw(10) << "precision"
        << std::setw(8) << "recall" << std::setw(10) << "precision" << std::setw(8) << "recall"
        << "\n";
    for (const OpenLoopModel& model : result.models) {
        const evaluation::Latency update = evaluation::latencyOf(model.update_ms);
        out << std::left << std::setw(width) << displayName(model.name) << std::right
            << cell(update.p50_ms, 2, 8) << cell(update.p95_ms, 2, 8) << cell(update.max_ms, 2, 8)
            << cell(evaluation::latencyOf(model.queries_ms).p50_ms, 2, 9)
            << cell(model.peak_heap_bytes / 1e6, 1, 9)
            << cell(evaluation::latencyOf(model.obstacles).p50_ms, 0, 10)
            << cell(model.all.precision(), 3, 10) << cell(model.all.recall(), 3, 8)
            << cell(model.level.precision(), 3, 10) << cell(model.level.recall(), 3, 8) << "\n";
    }
}

void addAgreement(std::ostream& out, const OpenLoopResult& result) {
    if (result.models.size() < 2) return;
    constexpr int kWidth = 7;
    const auto number = [](std::size_t model) { return "(" + std::to_string(model + 1) + ")"; };
    // Columns are numbered, because the names are too wide.
    const int width = nameWidth(result) + 5;
    out << "\nagreement on free directions (Jaccard)\n" << std::setw(width) << "" << std::right;
    for (std::size_t b = 0; b < result.models.size(); ++b) out << std::setw(kWidth) << number(b);
    out << "\n";
    for (std::size_t a = 0; a < result.models.size(); ++a) {
        out << std::left << std::setw(5) << number(a) << std::setw(width - 5)
            << displayName(result.models[a].name) << std::right;
        for (std::size_t b = 0; b < result.models.size(); ++b) {
            out << cell(result.agreement[a][b], 3, kWidth);
        }
        out << "\n";
    }
}

}  // namespace

std::string tableOf(const OpenLoop& open_loop, const OpenLoopResult& result) {
    const evaluation::Latency filter = evaluation::latencyOf(result.filter_ms);
    base::TextStream out;
    out << base::counted(result.scans, "scan") << " of " << open_loop.source.log.string()
        << ", poses from " << result.poses << "\n"
        << "per scan: " << cell(evaluation::latencyOf(result.returns).p50_ms, 0, 0) << " returns, "
        << cell(evaluation::latencyOf(result.roi).p50_ms, 0, 0) << " of them RoI; filter "
        << cell(filter.p50_ms, 2, 0) << " ms (p95 " << cell(filter.p95_ms, 2, 0) << ", max "
        << cell(filter.max_ms, 2, 0) << ")\n"
        << "truth: " << truthOf(open_loop) << "; blocked directions, precision and recall\n\n";
    addModels(out, result);
    addAgreement(out, result);
    return out.str();
}

}  // namespace hagen::avoidance
