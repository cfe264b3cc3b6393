#include "Measurement.h"

#include <algorithm>
#include <atomic>
#include <exception>
#include <iostream>
#include <mutex>
#include <thread>
#include "evaluation/Breakdown.h"

#include "Rows.h"
#include "evaluation/labelled_folders/LabelledFolders.h"

namespace hagen {
namespace {

std::optional<evaluation::LabelMap> labelMapOf(const DataSet& set,
                                               const MeasurementOptions& options) {
    if (set.label_map.empty()) return std::nullopt;
    return evaluation::readLabelMap(options.config / set.label_map);
}

Measured measure(const DataSet& set, const evaluation::MethodSet& rows,
                 const MeasurementOptions& options, bool has_camera) {
    const std::optional<evaluation::LabelMap> label_map = labelMapOf(set, options);
    evaluation::EvaluationOptions evaluation;
    evaluation.range.max_range_m = set.max_range_m;
    if (has_camera)
        evaluation.camera = evaluation::readCamera(options.config / "camera_forward.yaml");
    const evaluation::LabelledScanSources sources =
        evaluation::sourcesOf(scanFolders(set), rows, label_map);

    Measured measured{set, {}, {}, {}, {}};
    for (const auto& source : sources) measured.folders.push_back(source->name());
    measured.methods =
        evaluation::evaluate(sources, evaluation, [&](const evaluation::MethodOutput& view) {
            if (view.method == 0) measured.returns.push_back(view.truth.input.scan.size());
        });
    return measured;
}

/// Calls `work` with 0 ... count - 1 in several threads; rethrows an exception at the end.
template <class Work>
void inParallel(std::size_t count, unsigned jobs, Work work) {
    std::atomic<std::size_t> next{0};
    std::exception_ptr failure;
    std::mutex guard;
    std::vector<std::thread> threads;
    for (unsigned job = 0; job < std::max(1u, jobs); ++job) {
        threads.emplace_back([&] {
            for (std::size_t i = next++; i < count; i = next++) {
                try {
                    work(i);
                } catch (...) {
                    const std::lock_guard<std::mutex> lock(guard);
                    if (!failure) failure = std::current_exception();
                    next = count;
                }
            }
        });
    }
    for (std::thread& thread : threads) thread.join();
    if (failure) std::rethrow_exception(failure);
}

}  // namespace

const evaluation::MethodScores* Measured::row(const std::string& name) const {
    const auto found =
        std::find_if(methods.begin(), methods.end(),
                     [&](const evaluation::MethodScores& m) { return m.name == name; });
    return found == methods.end() ? nullptr : &*found;
}

std::int64_t Measured::scoredReturns() const {
    return evaluation::overallScores(methods.front().returns).sum().returns();
}

std::vector<Measured> measureScores(const std::vector<DataSet>& sets,
                                    const MeasurementOptions& options) {
    // Report invalid settings before the long simulation.
    for (const DataSet& set : sets) rowsFor(set, options.config);
    std::vector<Measured> all(sets.size());
    std::mutex guard;
    // Start the slowest sets first.
    std::vector<std::size_t> order(sets.size());
    for (std::size_t i = 0; i < order.size(); ++i) order[i] = order.size() - 1 - i;
    inParallel(sets.size(), options.jobs, [&](std::size_t i) {
        const DataSet& set = sets[order[i]];
        makeFlights(set, options.simulation_tag);
        all[order[i]] = measure(set, rowsFor(set, options.config), options, set.has_all_rows);
        const std::lock_guard<std::mutex> lock(guard);
        std::cerr << "scored: " << set.name << "\n";
    });
    return all;
}

void measureHardSets(std::vector<Measured>& all, const MeasurementOptions& options) {
    struct Task {
        Measured* measured;
        evaluation::Degradation degradation;
        evaluation::HardSet result;
    };
    std::vector<Task> tasks;
    const auto inputsOf = [&](const DataSet& set) {
        evaluation::MethodSet rows = headlineRowsFor(set, options.config);
        rows.filter.resize(1);  // `default`
        rows.baselines.reset();
        return evaluation::LabelledInputs{scanFolders(set), rows, labelMapOf(set, options)};
    };
    for (Measured& measured : all) {
        if (!measured.set.is_degraded) continue;
        for (const auto& d : evaluation::degradationsOf({}, true, inputsOf(measured.set)))
            tasks.push_back({&measured, d, {}});
    }
    inParallel(tasks.size(), options.jobs, [&](std::size_t i) {
        const DataSet& set = tasks[i].measured->set;
        tasks[i].result =
            evaluation::scoreHardSets(inputsOf(set), {tasks[i].degradation}, {set.max_range_m})
                .front();
    });
    for (Task& task : tasks) task.measured->hard_sets.push_back(std::move(task.result));
    if (!tasks.empty()) std::cerr << "scored: hard sets\n";
}

std::vector<Measured> measureTimes(const std::vector<DataSet>& sets,
                                   const MeasurementOptions& options) {
    std::vector<Measured> all;
    for (const DataSet& set : sets) {
        if (!set.is_timed) continue;
        all.push_back(measure(set, headlineRowsFor(set, options.config), options, false));
        std::cerr << "timed: " << set.name << "\n";
    }
    return all;
}

}  // namespace hagen
