#include <hagen/evaluation/Scores.h>

namespace hagen::evaluation {
namespace {

double ratio(std::int64_t part, std::int64_t whole) {
    return static_cast<double>(part) / static_cast<double>(whole);
}

void addScore(bool is, bool found, ClassScore& score) {
    score.hits += is && found;
    score.misses += is && !found;
    score.false_alarms += !is && found;
}

}  // namespace

double ClassScore::precision() const { return ratio(hits, hits + false_alarms); }
double ClassScore::recall() const { return ratio(hits, hits + misses); }
double ClassScore::f1() const { return ratio(2 * hits, 2 * hits + misses + false_alarms); }

ClassScore& ClassScore::operator+=(const ClassScore& other) {
    hits += other.hits;
    misses += other.misses;
    false_alarms += other.false_alarms;
    return *this;
}

std::int64_t Scores::returns() const { return roi.hits + roi.misses + rou.hits + rou.misses; }
double Scores::correct() const { return ratio(roi.hits + rou.hits, returns()); }

Scores& Scores::operator+=(const Scores& other) {
    roi += other.roi;
    rou += other.rou;
    return *this;
}

void addScore(Label truth, Label found, Scores& scores) {
    if (truth == Label::Unclassified) return;
    addScore(truth == Label::Roi, found == Label::Roi, scores.roi);
    addScore(truth == Label::Rou, found == Label::Rou, scores.rou);
}

}  // namespace hagen::evaluation
