#include <hagen/range_image/Angle.h>
#include <hagen/range_image/AppendReturn.h>
#include <hagen/range_image/RangeImage.h>
#include <hagen/streaming/StreamingSegmenter.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <stdexcept>
#include <string>
#include <utility>

namespace hagen::streaming {
namespace {

constexpr double kTurn_rad = 2 * kPi;
constexpr std::size_t kMostPackets = 4000;  // whatever the clock says; a turn has up to 600
constexpr double kRounding_rad = 0.01;      // of where packets begin and end
constexpr double kMargin_rad = 0.02;        // of the sector's image, ahead of it
constexpr int kEmptyColumns = 16;           // are two columns, where no returns are kept
// Less than this moves no return to another pixel.
constexpr double kLeastMotion_m = 0.01, kLeastMotion_rad = 1e-3;

template <class Value>
void append(const std::vector<Value>& from, std::vector<Value>& to) {
    to.insert(to.end(), from.begin(), from.end());
}

/// Calls visit(a, b) for each array of two scans.
template <class A, class B, class Visit>
void forEachArray(A& a, B& b, Visit visit) {
    visit(a.x_m, b.x_m);
    visit(a.y_m, b.y_m);
    visit(a.z_m, b.z_m);
    visit(a.intensity, b.intensity);
    visit(a.range_m, b.range_m);
    visit(a.azimuth_rad, b.azimuth_rad);
    visit(a.row, b.row);
}

void append(const Scan& from, Scan& to) {
    forEachArray(from, to, [](const auto& values, auto& all) { append(values, all); });
}

bool isStill(const Eigen::Isometry3d& motion) {
    return motion.translation().norm() < kLeastMotion_m &&
           Eigen::AngleAxisd(motion.linear()).angle() < kLeastMotion_rad;
}

/// The angle between two directions that a sensor swept, at most a turn apart.
double between(const Sweep& a, const Sweep& b) {
    const double apart_rad = std::abs(a.from_rad + a.to_rad - b.from_rad - b.to_rad) / 2;
    const double middle_rad = std::min(apart_rad, std::abs(kTurn_rad - apart_rad));
    return middle_rad - (a.to_rad - a.from_rad + b.to_rad - b.from_rad) / 2;
}

void check(bool is_right, const std::string& what) {
    if (!is_right) throw std::invalid_argument("streaming: " + what);
}

}  // namespace

StreamingSegmenter::StreamingSegmenter(SensorModel sensor, Options options, Take take,
                                       const StreamingOptions& streaming)
    : filter_(std::move(sensor), options),
      sector_filter_(filter_.sensor(), options),
      streaming_(streaming),
      take_(std::move(take)) {
    check(streaming.sector_rad > 0 && streaming.sector_rad <= kTurn_rad,
          "sector_rad must be above 0 and at most a turn");
    check(streaming.window_rad >= 0, "window_rad must not be negative");
    check(streaming.skip_ahead_rad >= 0 && streaming.skip_ahead_rad < kPi,
          "skip_ahead_rad must be at least 0 and less than half a turn");
    check(streaming.keep_every >= 0, "keep_every must not be negative");
    check(streaming.context_s > 0, "context_s must be positive");
    check(streaming.least_known_rad >= 0 && streaming.least_known_rad <= kTurn_rad,
          "least_known_rad must be at least 0 and at most a turn");
    check(streaming.longest_sector_s > 0, "longest_sector_s must be positive");
    check(take_ != nullptr, "there is no function that takes the sectors");
}

void StreamingSegmenter::Returns::clear() {
    scan.clear();
    region.clear();
}

void StreamingSegmenter::Returns::append(const Returns& other, std::size_t i) {
    appendReturn(other.scan, i, scan);
    region.push_back(other.region[i]);
}

void StreamingSegmenter::Returns::append(const Returns& other, std::size_t first, std::size_t end) {
    const auto appendPart = [=](const auto& values, auto& all) {
        all.insert(all.end(), values.begin() + static_cast<std::ptrdiff_t>(first),
                   values.begin() + static_cast<std::ptrdiff_t>(end));
    };
    forEachArray(other.scan, scan, appendPart);
    appendPart(other.region, region);
}

void StreamingSegmenter::Returns::eraseFirst(std::size_t number) {
    const auto erase = [=](auto& values, auto&) {
        values.erase(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(number));
    };
    forEachArray(scan, scan, erase);
    erase(region, region);
}

void StreamingSegmenter::setAttitude(const std::optional<Attitude>& attitude) {
    attitude_ = attitude;
}

void StreamingSegmenter::setPose(const std::optional<Eigen::Isometry3d>& map_from_sensor) {
    pose_ = map_from_sensor;
}

StreamingSegmenter::Packet& StreamingSegmenter::push(const Scan& returns, double time_s) {
    checkLocated(returns, filter_.sensor());
    if (packets_.size() >= kMostPackets) restart();
    if (spare_.empty()) {
        packets_.emplace_back();
    } else {
        packets_.push_back(std::move(spare_.back()));
        spare_.pop_back();
    }
    ++open_;
    Packet& packet = packets_.back();
    packet.all.clear();
    append(returns, packet.all.scan);
    packet.all.scan.intensity.resize(returns.size());
    packet.all.scan.beams = returns.beams;
    packet.all.region.resize(returns.size(), Label::Unclassified);
    packet.thinned_first = packet.thinned_end = 0;
    packet.sweep.reset();
    packet.time_s = time_s;
    packet.pose = pose_;
    packet.has_place = pose_.has_value();
    if (!pose_ && attitude_) {
        packet.pose = Eigen::Isometry3d::Identity();
        packet.pose->linear() = levelFromSensor(*attitude_).cast<double>();
    }
    return packet;
}

/// Each n-th column, so that those that are left have all their beams.
void StreamingSegmenter::thin(Packet& packet) {
    packet.thinned_first = packet.thinned_end = thinned_.scan.size();
    if (streaming_.keep_every == 0) return;
    const std::vector<float>& azimuth_rad = packet.all.scan.azimuth_rad;
    for (std::size_t i = 0; i < azimuth_rad.size(); ++i) {
        const int column = nearestColumn(azimuth_rad[i], filter_.options().columns);
        if (column % streaming_.keep_every == 0) thinned_.append(packet.all, i);
    }
    packet.thinned_end = thinned_.scan.size();
}

/// Those of packets that were forgotten, once they are most of them.
void StreamingSegmenter::forgetThinned() {
    const std::size_t known = packets_.size() - open_;
    const std::size_t first = known > 0 ? packets_.front().thinned_first : thinned_.scan.size();
    if (2 * first < thinned_.scan.size()) return;
    thinned_.eraseFirst(first);
    for (std::size_t i = 0; i < known; ++i) {
        packets_[i].thinned_first -= first;
        packets_[i].thinned_end -= first;
    }
}

void StreamingSegmenter::add(const Scan& returns, const Sweep& sweep, double time_s) {
    if (open_ > 0 && time_s - packets_[packets_.size() - open_].time_s > streaming_.context_s) {
        flush();
    }
    const bool is_first = packets_.empty();
    Packet& packet = push(returns, time_s);
    packet.sweep = sweep;
    if (is_first) {
        head_rad_ = sweep.to_rad;
        start_rad_ = sweep.from_rad;
    } else {
        head_rad_ = std::max(head_rad_, sweep.to_rad);
        if (open_ == 1) start_rad_ = sweep.from_rad;
        start_rad_ = std::min(start_rad_, sweep.from_rad);
    }
    const double swept_rad = head_rad_ - start_rad_;
    const double packet_rad = std::max(0.0, sweep.to_rad - sweep.from_rad);
    const double lasted_s = time_s - packets_[packets_.size() - open_].time_s;
    if (swept_rad + packet_rad > streaming_.sector_rad * (1 + 1e-9) ||
        lasted_s > streaming_.longest_sector_s) {
        label(false);
    }
}

void StreamingSegmenter::addFrame(const Scan& returns, double time_s) {
    push(returns, time_s);
    label(false);
}

void StreamingSegmenter::flush() {
    if (open_ > 0) label(true);
}

void StreamingSegmenter::restart() {
    flush();
    std::move(packets_.begin(), packets_.end(), std::back_inserter(spare_));
    packets_.clear();
}

/// Packets that were overwritten by the latest turn, or that are too old. A clock that went back
/// does not tell how old they are.
void StreamingSegmenter::forget(double now_s) {
    while (packets_.size() > open_) {
        const Packet& oldest = packets_.front();
        const bool is_overwritten = oldest.sweep && oldest.sweep->to_rad <= head_rad_ - kTurn_rad;
        const double age_s = now_s - oldest.time_s;
        if (!is_overwritten && age_s >= 0 && age_s < streaming_.context_s) break;
        spare_.push_back(std::move(packets_.front()));
        packets_.pop_front();
    }
}

/// The returns ahead of the sensor of a packet that it has begun to overwrite.
void StreamingSegmenter::addAhead(const Returns& returns, std::size_t first, std::size_t end) {
    for (std::size_t i = first; i < end; ++i) {
        const double clockwise_rad = -static_cast<double>(returns.scan.azimuth_rad[i]);
        if (std::remainder(clockwise_rad - head_rad_, kTurn_rad) > 0) window_.append(returns, i);
    }
}

/// Stretches that follow each other are copied at once. An empty one ends the last.
void StreamingSegmenter::addThinned(std::size_t first, std::size_t end) {
    if (first != pending_end_ || first == end) {
        window_.append(thinned_, pending_first_, pending_end_);
        pending_first_ = first;
    }
    pending_end_ = end;
}

/// Beams are located later, all at once.
void StreamingSegmenter::addMoved(const Returns& returns, std::size_t first, std::size_t end,
                                  const Eigen::Isometry3d& motion) {
    const Eigen::Matrix3f turn = motion.linear().cast<float>();
    const Eigen::Vector3f way_m = motion.translation().cast<float>();
    const Scan& scan = returns.scan;
    Scan& moved = moved_.scan;
    std::size_t at = moved.size();
    for (auto* values : {&moved.x_m, &moved.y_m, &moved.z_m, &moved.intensity}) {
        values->resize(at + end - first);
    }
    moved_.region.resize(at + end - first);
    for (std::size_t i = first; i < end; ++i) {
        const float x_m = scan.x_m[i], y_m = scan.y_m[i], z_m = scan.z_m[i];
        moved.x_m[at] = turn(0, 0) * x_m + turn(0, 1) * y_m + turn(0, 2) * z_m + way_m.x();
        moved.y_m[at] = turn(1, 0) * x_m + turn(1, 1) * y_m + turn(1, 2) * z_m + way_m.y();
        moved.z_m[at] = turn(2, 0) * x_m + turn(2, 1) * y_m + turn(2, 2) * z_m + way_m.z();
        moved.intensity[at] = scan.intensity[i];
        moved_.region[at] = returns.region[i];
        at += std::isfinite(scan.range_m[i]);  // the airframe moves with the sensor
    }
    for (auto* values : {&moved.x_m, &moved.y_m, &moved.z_m, &moved.intensity}) {
        values->resize(at);
    }
    moved_.region.resize(at);
}

void StreamingSegmenter::addContext(const Packet& packet, const Sweep& sector) {
    bool is_near = true, is_cut = false;
    const Packet& latest = packets_.back();
    // A tilt and a pose do not compare: the pose has a heading and a place.
    const bool has_motion = packet.pose && latest.pose && packet.has_place == latest.has_place;
    if (packet.sweep) {
        const double ahead_rad = packet.sweep->from_rad - (head_rad_ - kTurn_rad);
        if (!has_motion && ahead_rad < streaming_.skip_ahead_rad) return;
        is_near = between(*packet.sweep, sector) <= streaming_.window_rad;
        is_cut = packet.sweep->from_rad < head_rad_ - kTurn_rad;
    }
    const Returns& returns = is_near ? packet.all : thinned_;
    const std::size_t first = is_near ? 0 : packet.thinned_first;
    const std::size_t end = is_near ? packet.all.scan.size() : packet.thinned_end;
    if (has_motion && !is_cut) {
        const Eigen::Isometry3d motion = latest.pose->inverse() * *packet.pose;
        if (!isStill(motion)) return addMoved(returns, first, end, motion);
    }
    if (is_cut) return addAhead(returns, first, end);
    if (!is_near) return addThinned(first, end);
    window_.append(returns, first, end);
}

/// Whether enough is in sight to tell what is ground.
bool StreamingSegmenter::knowsEnough() const {
    double known_rad = 0;
    for (const Packet& packet : packets_) {
        if (packet.sweep) known_rad += packet.sweep->to_rad - packet.sweep->from_rad;
    }
    if (!packets_.back().sweep) {
        const double known_s = packets_.back().time_s - packets_.front().time_s;
        known_rad = kTurn_rad * known_s / streaming_.context_s;
    }
    return known_rad >= streaming_.least_known_rad - kRounding_rad;
}

/// The columns of the image: all in and beside the sector, and those that are kept elsewhere. The
/// image has the same size for each sector, unless late packets make one wide. Returns false if
/// that is the whole turn.
bool StreamingSegmenter::mapWindow(const Sweep& sector) {
    const int columns = filter_.options().columns;
    const Sweep& latest = *packets_.back().sweep;
    const double beside_rad = streaming_.window_rad + (latest.to_rad - latest.from_rad);
    // Without motion, there is nothing ahead that needs narrow columns.
    const bool has_ahead = packets_.back().pose || streaming_.skip_ahead_rad < beside_rad;
    const double usual_rad =
        std::max(streaming_.sector_rad, sector.to_rad - sector.from_rad) + beside_rad;
    const double width_rad = usual_rad + (has_ahead ? beside_rad : kMargin_rad);
    const int group = streaming_.keep_every > 0 ? streaming_.keep_every : kEmptyColumns;
    const int groups = (columns + group - 1) / group;
    const double group_rad = kTurn_rad * group / columns;
    const int count = static_cast<int>(std::ceil(width_rad / group_rad)) + 1;
    if (count >= groups) return false;
    const double end_rad = sector.to_rad + (has_ahead ? beside_rad : kMargin_rad);
    const auto first_rad = static_cast<float>(std::remainder(width_rad - end_rad, kTurn_rad));
    mapColumns(columns, group, nearestColumn(first_rad, columns) / group, count, columns_);
    return true;
}

/// The labels of the sector, and its regions.
const SegmentationResult& StreamingSegmenter::judge() {
    const bool is_upright =
        !filter_.options().level_by_attitude || postureOf(attitude_) == Posture::Upright;
    const std::optional<Sweep>& sweep = packets_.back().sweep;
    if (sweep && is_upright && mapWindow({start_rad_, head_rad_})) {
        const SegmentationResult& result =
            sector_filter_.segment(window_.scan, attitude_, {sector_, columns_, window_.region});
        labels_ = result.returns.label;
        regions_ = sector_filter_.regions();
        return result;
    }
    const SegmentationResult& result = filter_.segment(window_.scan, attitude_);
    labels_.assign(result.returns.label.begin(),
                   result.returns.label.begin() + static_cast<std::ptrdiff_t>(sector_.size()));
    regions_ = labels_;
    return result;
}

/// From now on, the sector's packets are context.
void StreamingSegmenter::keepRegions() {
    forgetThinned();
    auto from = regions_.begin();
    for (std::size_t i = packets_.size() - open_; i < packets_.size(); ++i) {
        std::vector<Label>& region = packets_[i].all.region;
        const auto to = from + static_cast<std::ptrdiff_t>(region.size());
        std::copy(from, to, region.begin());
        from = to;
        thin(packets_[i]);
    }
}

void StreamingSegmenter::label(bool is_cut) {
    forget(packets_.back().time_s);
    const std::size_t first_open = packets_.size() - open_;
    const Packet& first = packets_[first_open];
    const Packet& last = packets_.back();
    const Sweep sector{start_rad_, head_rad_};

    // The sector comes first, so that its labels are the first ones.
    sector_.clear();
    sweeps_.clear();
    for (std::size_t i = first_open; i < packets_.size(); ++i) {
        append(packets_[i].all.scan, sector_);
        if (packets_[i].sweep) sweeps_.push_back(*packets_[i].sweep);
    }
    sector_.beams = last.all.scan.beams;
    window_.clear();
    append(sector_, window_.scan);
    window_.scan.beams = sector_.beams;
    window_.region.resize(sector_.size(), Label::Unclassified);
    moved_.clear();
    pending_first_ = pending_end_ = 0;
    for (std::size_t i = 0; i < first_open; ++i) addContext(packets_[i], sector);
    addThinned(0, 0);
    locateBeams(filter_.sensor(), moved_.scan);
    window_.append(moved_, 0, moved_.scan.size());

    const SegmentationResult& result = judge();
    keepRegions();
    const bool is_doubtful = !knowsEnough();
    if (is_doubtful) {
        for (std::size_t i = 0; i < labels_.size(); ++i) {
            const bool is_in_zone = sector_.range_m[i] <= filter_.options().zone_m;
            if (labels_[i] == Label::Rou && is_in_zone) labels_[i] = Label::Roi;
        }
    }
    const bool turns = last.sweep.has_value();
    const std::optional<Sweep>& oldest = packets_.front().sweep;
    const bool has_turn =
        turns ? oldest && oldest->from_rad < head_rad_ - kTurn_rad + kRounding_rad : first_open > 0;
    ++sectors_;
    open_ = 0;
    take_({sector_, labels_, turns ? std::optional<Sweep>(sector) : std::nullopt, first.time_s,
           last.time_s, has_turn, is_doubtful, is_cut, result, &sweeps_});
}

}  // namespace hagen::streaming
