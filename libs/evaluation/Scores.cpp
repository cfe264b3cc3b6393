#include <hagen/evaluation/Scores.h>
#include <stdexcept>
#include <string>

namespace hagen {
namespace {

double ratio(std::int64_t part, std::int64_t whole) {
    return static_cast<double>(part) / static_cast<double>(whole);
}

void addReturn(bool is, bool found, ClassScore& score) {
    score.hits += is && found;
    score.misses += is && !found;
    score.false_alarms += !is && found;
}

}  // namespace

double ClassScore::precision() const { return ratio(hits, hits + false_alarms); }
double ClassScore::recall() const { return ratio(hits, hits + misses); }
double ClassScore::f1() const { return ratio(2 * hits, 2 * hits + misses + false_alarms); }

void addScores(const Scan& scan, const std::vector<std::uint16_t>& truth,
               const std::vector<Label>& found, float max_range_m, Scores& scores) {
    if (truth.size() != scan.size() || found.size() != scan.size()) {
        throw std::invalid_argument(std::to_string(scan.size()) + " returns, but " +
                                    std::to_string(truth.size()) + " true and " +
                                    std::to_string(found.size()) + " found labels");
    }
    for (std::size_t i = 0; i < scan.size(); ++i) {
        if (truth[i] > static_cast<std::uint16_t>(Label::Roi)) {
            throw std::invalid_argument("label " + std::to_string(truth[i]) +
                                        " is none of 0 (unclassified), 1 (ROU), 2 (RoI)");
        }
        const Label is = static_cast<Label>(truth[i]);
        if (is == Label::Unclassified || !(scan.range_m[i] <= max_range_m)) continue;
        addReturn(is == Label::Roi, found[i] == Label::Roi, scores.roi);
        addReturn(is == Label::Rou, found[i] == Label::Rou, scores.rou);
    }
}

}  // namespace hagen
