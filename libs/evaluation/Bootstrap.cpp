#include "evaluation/Bootstrap.h"
#include <algorithm>
#include <random>
#include "base/Quantile.h"

namespace hagen::evaluation {
namespace {

template <class Figure>
Interval intervalOf(const std::vector<Scores>& resamples, double level, Figure figure) {
    std::vector<double> values;
    values.reserve(resamples.size());
    for (const Scores& scores : resamples) {
        const double value = figure(scores);
        if (!std::isnan(value)) values.push_back(value);
    }
    if (values.empty()) return {};
    std::sort(values.begin(), values.end());
    const double tail = (1 - level) / 2;
    return {base::quantileOfSorted(values, tail), base::quantileOfSorted(values, 1 - tail)};
}

std::vector<Scores> bootstrapResamples(const std::vector<Scores>& scans,
                                       const BootstrapOptions& options) {
    std::mt19937_64 random(options.seed);  // same numbers on every machine
    std::vector<Scores> resamples(static_cast<std::size_t>(options.resamples));
    for (Scores& sum : resamples) {
        options.continuing();
        for (std::size_t i = 0; i < scans.size(); ++i) sum += scans[random() % scans.size()];
    }
    return resamples;
}

}  // namespace

ScoreIntervals bootstrapIntervals(const std::vector<Scores>& scans,
                                  const BootstrapOptions& options) {
    ScoreIntervals intervals;
    if (scans.size() < 2 || options.resamples <= 0) return intervals;
    const std::vector<Scores> resamples = bootstrapResamples(scans, options);
    const auto of = [&](auto figure) { return intervalOf(resamples, options.level, figure); };
    const auto ofClass = [&](ClassScore Scores::*c) {
        return ScoreIntervals::OfClass{of([c](const Scores& s) { return (s.*c).precision(); }),
                                       of([c](const Scores& s) { return (s.*c).recall(); }),
                                       of([c](const Scores& s) { return (s.*c).f1(); })};
    };
    intervals.roi = ofClass(&Scores::roi);
    intervals.rou = ofClass(&Scores::rou);
    intervals.correct = of([](const Scores& s) { return s.correct(); });
    return intervals;
}

}  // namespace hagen::evaluation
