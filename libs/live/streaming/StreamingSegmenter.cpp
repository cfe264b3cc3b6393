#include <hagen/live/StreamingSegmenter.h>
#include <hagen/scan/Angle.h>
#include <hagen/scan/RangeImage.h>
#include "filter/image/Posture.h"
#include "scan/AppendReturn.h"
#include "scan/MoveReturns.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <stdexcept>
#include <string>
#include <utility>

#include "live/streaming/CheckTime.h"

namespace hagen::live {
namespace {

constexpr std::size_t kMaxPackets = 4000;  // of a turn, even if the clock stops; usually up to 600
constexpr double kMaxTurns = 1.5;          // extrapolation of motion from the ground
constexpr double kFrame_s = 0.1;           // a scan of a sensor without a rotating head
constexpr double kEnoughOfView = 0.9;      // of a limited field of view
constexpr double kPacketEnd_rad = 0.01;    // tolerance of packet boundaries
// A beam's correction may add half a turn, and nearestColumn() wraps only once.
constexpr float kMaxAzimuth_rad = 7.8F;
constexpr double kMaxRotation_rad = 1e12;  // 250 years at 20 Hz; still exact to 0.1 mrad
constexpr double kMargin_rad = 0.02;       // added to the sector's image ahead of the sector
constexpr int kEmptyColumns = 16;  // group width where no returns are kept; shown as two columns
// With smaller motions, all returns stay in their pixels.
constexpr double kMinMotion_m = 0.01, kMinMotion_rad = 1e-3;

std::optional<Attitude> ifFinite(const std::optional<Attitude>& attitude) {
    const bool is_known =
        attitude && std::isfinite(attitude->roll_rad) && std::isfinite(attitude->pitch_rad);
    return is_known ? attitude : std::nullopt;
}

/// Sign of the upward direction along the sensor's z axis; 0 for a sensor on its side.
float upOf(const std::optional<Attitude>& tilt, const SensorModel& sensor) {
    const Posture posture = postureOf(tilt, sensor);
    if (posture == Posture::Upright) return 1;
    return posture == Posture::UpsideDown ? -1 : 0;
}

bool isStill(const Eigen::Isometry3d& motion) {
    return motion.translation().norm() < kMinMotion_m &&
           Eigen::AngleAxisd(motion.linear()).angle() < kMinMotion_rad;
}

/// The smallest angle between two sweeps, ignoring whole turns.
double between(const Sweep& a, const Sweep& b) {
    const double apart_rad = (a.from_rad + a.to_rad - b.from_rad - b.to_rad) / 2;
    const double middle_rad = std::abs(std::remainder(apart_rad, kTurn_rad));
    return middle_rad - (a.to_rad - a.from_rad + b.to_rad - b.from_rad) / 2;
}

void checkSweep(const Sweep& sweep) {
    const double swept_rad = sweep.to_rad - sweep.from_rad;
    const bool is_sound = std::abs(sweep.from_rad) <= kMaxRotation_rad && swept_rad >= 0 &&
                          swept_rad <= kTurn_rad + kPacketEnd_rad;
    if (!is_sound) {
        throw std::invalid_argument(
            "streaming: the sweep of a packet must be clockwise, span at most one turn, and start "
            "within 1e12 rad");
    }
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
      thinning_(filter_.sensor().rows(), filter_.options().columns,
                std::max(streaming.keep_every, 0)),
      turn_motion_(filter_.sensor().rows(), filter_.options().columns, options.zone_m),
      take_(std::move(take)),
      turns_(options.window_scans),
      max_age_s_(filter_.sensor().has_rings ? streaming.context_s * turns_
                                            : streaming.context_s + kFrame_s * (turns_ - 1)) {
    check(streaming.sector_rad > 0 && streaming.sector_rad <= kTurn_rad,
          "sector_rad must be above 0 and at most a turn");
    check(streaming.window_rad >= 0, "window_rad must not be negative");
    const auto isAhead = [](double angle_rad) { return angle_rad >= 0 && angle_rad < kPi; };
    check(isAhead(streaming.skip_ahead_rad),
          "skip_ahead_rad must be at least 0 and less than half a turn");
    check(isAhead(streaming.skip_ahead_moved_rad),
          "skip_ahead_moved_rad must be at least 0 and less than half a turn");
    check(streaming.keep_every >= 0, "keep_every must not be negative");
    check(streaming.context_s > 0, "context_s must be positive");
    check(streaming.min_known_rad >= 0 && streaming.min_known_rad <= kTurn_rad,
          "min_known_rad must be at least 0 and at most a turn");
    check(streaming.longest_sector_s > 0, "longest_sector_s must be positive");
    check(take_ != nullptr, "no callback for sectors");
}

void StreamingSegmenter::Returns::clear() {
    scan.clear();
    found.clear();
}

void StreamingSegmenter::Returns::append(const Returns& other, std::size_t i) {
    appendReturn(other.scan, i, scan);
    found.push_back(other.found[i]);
}

void StreamingSegmenter::Returns::append(const Returns& other, std::size_t first, std::size_t end) {
    const auto appendPart = [=](const auto& values, auto& all) {
        all.insert(all.end(), values.begin() + static_cast<std::ptrdiff_t>(first),
                   values.begin() + static_cast<std::ptrdiff_t>(end));
    };
    forEachArray(other.scan, scan, appendPart);
    appendPart(other.found, found);
}

void StreamingSegmenter::Returns::eraseFirst(std::size_t number) {
    const auto erase = [=](auto& values, auto&) {
        values.erase(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(number));
    };
    forEachArray(scan, scan, erase);
    erase(found, found);
}

void StreamingSegmenter::setAttitude(const std::optional<Attitude>& attitude) {
    attitude_ = ifFinite(attitude);
}

void StreamingSegmenter::setPose(const std::optional<Eigen::Isometry3d>& map_from_sensor) {
    const bool is_known = map_from_sensor && map_from_sensor->matrix().allFinite();
    pose_ = is_known ? map_from_sensor : std::nullopt;
}

void StreamingSegmenter::setMount(const std::optional<Attitude>& tilt) { mount_ = ifFinite(tilt); }

void StreamingSegmenter::setBeamOffsets(const BeamOffsets& offsets) {
    const auto isSound = [](double angle_rad) { return angle_rad >= 0 && angle_rad <= kTurn_rad; };
    check(isSound(offsets.behind_rad) && isSound(offsets.ahead_rad),
          "beam offsets must be from 0 to a full turn");
    offsets_ = offsets;
}

StreamingSegmenter::Packet& StreamingSegmenter::push(const Scan& returns, double time_s) {
    checkLocated(returns, filter_.sensor());
    const auto isUsable = [](float azimuth_rad) {
        return std::abs(azimuth_rad) <= kMaxAzimuth_rad;
    };
    if (!std::all_of(returns.azimuth_rad.begin(), returns.azimuth_rad.end(), isUsable)) {
        throw std::invalid_argument("streaming: a return has no azimuth, or one beyond 7.8 rad");
    }
    if (packets_.size() >= kMaxPackets * static_cast<std::size_t>(turns_)) restart();
    if (spare_.empty()) {
        packets_.emplace_back();
    } else {
        packets_.push_back(std::move(spare_.back()));
        spare_.pop_back();
    }
    ++open_;
    Packet& packet = packets_.back();
    packet.all.clear();
    appendReturns(returns, packet.all.scan);
    packet.all.scan.intensity.resize(returns.size());
    packet.all.scan.beams = returns.beams;
    packet.all.found.resize(returns.size());
    packet.thinned_first = packet.thinned_end = 0;
    packet.sweep.reset();
    packet.measured_s = 0;
    packet.sensor_time_s.reset();
    packet.time_s = packet.first_time_s = time_s;
    packet.pose = pose_;
    packet.has_place = pose_.has_value();
    if (!pose_ && attitude_) {
        packet.pose = Eigen::Isometry3d::Identity();
        packet.pose->linear() = levelFromSensor(*attitude_).cast<double>();
    }
    return packet;
}

void StreamingSegmenter::thin(Packet& packet) {
    packet.thinned_first = thinned_.scan.size();
    for (const std::size_t i : thinning_.of(packet.all.scan, upOf(tilt(), filter_.sensor()))) {
        thinned_.append(packet.all, i);
    }
    packet.thinned_end = thinned_.scan.size();
}

/// Removes thinned returns of forgotten packets once they are the majority.
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
    checkSweep(sweep);
    checkTime(time_s);
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

void StreamingSegmenter::addFrame(const Scan& returns, double time_s, double measured_s,
                                  std::optional<double> first_time_s,
                                  std::optional<double> sensor_time_s) {
    checkTime(time_s);
    if (!(measured_s >= 0)) {
        throw std::invalid_argument("streaming: a frame has a negative measuring time");
    }
    const double first_s = first_time_s.value_or(time_s);
    checkTime(first_s);
    checkTime(sensor_time_s.value_or(0));
    if (first_s > time_s) {
        throw std::invalid_argument("streaming: a frame's first packet is later than its last");
    }
    Packet& packet = push(returns, time_s);
    packet.measured_s = measured_s;
    packet.sensor_time_s = sensor_time_s;
    packet.first_time_s = first_s;
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

/// Removes packets that are too old, that the turns of the window have overwritten, or whose age is
/// unknown because the clock went back.
void StreamingSegmenter::forget(double now_s) {
    const std::size_t known = packets_.size() - open_;
    const bool is_after_silence =
        known > 0 && !(now_s - packets_[known - 1].time_s < streaming_.context_s);
    const double max_age_s = is_after_silence ? 0 : max_age_s_;
    while (packets_.size() > open_) {
        const Packet& oldest = packets_.front();
        const bool is_overwritten =
            oldest.sweep && oldest.sweep->to_rad <= head_rad_ - kTurn_rad * turns_;
        const double age_s = now_s - oldest.time_s;
        if (!is_overwritten && age_s >= 0 && age_s < max_age_s) break;
        spare_.push_back(std::move(packets_.front()));
        packets_.pop_front();
    }
}

/// Merges contiguous stretches into one copy. An empty stretch flushes the last stretch.
void StreamingSegmenter::addThinned(std::size_t first, std::size_t end) {
    if (first != pending_end_ || first == end) {
        window_.append(thinned_, pending_first_, pending_end_);
        pending_first_ = first;
    }
    pending_end_ = end;
}

/// The transform of a packet's returns to the current sensor frame, if the motion since the packet
/// is known.
std::optional<Eigen::Isometry3d> StreamingSegmenter::motionSince(const Packet& packet) const {
    const Packet& latest = packets_.back();
    if (!packet.pose && !latest.pose && packet.sweep) {
        const double middle_rad = (packet.sweep->from_rad + packet.sweep->to_rad) / 2;
        const double turns = (head_rad_ - middle_rad) / kTurn_rad;
        return turns < kMaxTurns ? turn_motion_.since(turns) : std::nullopt;
    }
    // Poses without position are not comparable to others.
    if (!packet.pose || !latest.pose || packet.has_place != latest.has_place) return std::nullopt;
    return latest.pose->inverse() * *packet.pose;
}

/// Adds returns moved to the current sensor frame. Returns of a turn keep the pixels in which they
/// were measured, and thereby their neighbours. Returns of frames, which cover all directions, get
/// new pixels.
void StreamingSegmenter::addMoved(const Returns& returns, std::size_t first, std::size_t end,
                                  const Eigen::Isometry3d& motion, bool keeps_pixels) {
    Returns& to = keeps_pixels ? window_ : moved_;
    const std::size_t at = to.scan.size();
    if (keeps_pixels) {
        to.append(returns, first, end);
    } else {
        for (std::size_t i = first; i < end; ++i) {  // the airframe moves with the sensor
            if (std::isfinite(returns.scan.range_m[i])) to.append(returns, i);
        }
    }
    moveReturns(motion, at, to.scan);
}

void StreamingSegmenter::addContext(const Packet& packet, const Sweep& sector) {
    const std::optional<Eigen::Isometry3d> motion = motionSince(packet);
    const bool has_moved = motion && !isStill(*motion);
    bool is_near = true;
    if (isOlderThanTurn(packet)) return addOlderTurn(packet, sector, motion);
    if (packet.sweep) {
        double skip_rad = motion ? 0 : streaming_.skip_ahead_rad;
        if (has_moved) skip_rad = streaming_.skip_ahead_moved_rad;
        const double ahead_rad = packet.sweep->from_rad - (head_rad_ - kTurn_rad);
        if (ahead_rad < 0 && skip_rad == 0 && !has_moved) return addAhead(packet.all);
        if (ahead_rad < skip_rad) return;
        is_near = between(*packet.sweep, sector) <= streaming_.window_rad;
    }
    const Returns& returns = is_near ? packet.all : thinned_;
    const std::size_t first = is_near ? 0 : packet.thinned_first;
    const std::size_t end = is_near ? packet.all.scan.size() : packet.thinned_end;
    if (has_moved) return addMoved(returns, first, end, *motion, packet.sweep.has_value());
    if (!is_near) return addThinned(first, end);
    window_.append(returns, first, end);
}

/// Whether a packet belongs to an older turn of the sliding window, or is an older frame.
bool StreamingSegmenter::isOlderThanTurn(const Packet& packet) const {
    if (turns_ == 1) return false;
    if (packet.sweep) return packet.sweep->to_rad <= head_rad_ - kTurn_rad;
    return packets_.back().time_s - packet.time_s >= streaming_.context_s;
}

/// Adds the returns of an older turn near the sector. Without motion, they are only used if the
/// closest return counts, as in the paper.
void StreamingSegmenter::addOlderTurn(const Packet& packet, const Sweep& sector,
                                      const std::optional<Eigen::Isometry3d>& motion) {
    if (!motion && filter_.options().window_fills_gaps) return;
    if (packet.sweep) {
        const double ahead_rad = std::remainder(packet.sweep->from_rad - head_rad_, kTurn_rad);
        const double skip_rad =
            motion ? streaming_.skip_ahead_moved_rad : streaming_.skip_ahead_rad;
        const bool is_expired = packet.sweep->to_rad <= head_rad_ - kTurn_rad * turns_;
        if (is_expired || (ahead_rad >= 0 && ahead_rad < skip_rad)) return;
        if (between(*packet.sweep, sector) > streaming_.window_rad) return;
    }
    addMoved(packet.all, 0, packet.all.scan.size(), motion.value_or(Eigen::Isometry3d::Identity()),
             false);
}

/// Adds the returns ahead of the sensor from a partly overwritten packet.
void StreamingSegmenter::addAhead(const Returns& returns) {
    for (std::size_t i = 0; i < returns.scan.size(); ++i) {
        const double clockwise_rad = -static_cast<double>(returns.scan.azimuth_rad[i]);
        if (std::remainder(clockwise_rad - head_rad_, kTurn_rad) > 0) window_.append(returns, i);
    }
}

/// Whether the returns suffice to find the ground.
bool StreamingSegmenter::knowsEnough() const {
    double known_rad = 0;
    for (const Packet& packet : packets_) {
        if (packet.sweep && !isOlderThanTurn(packet))
            known_rad += packet.sweep->to_rad - packet.sweep->from_rad;
    }
    if (!packets_.back().sweep) {
        double measured_s = 0;
        double first_s = packets_.back().time_s;
        for (const Packet& packet : packets_) {
            if (isOlderThanTurn(packet)) continue;
            measured_s += packet.measured_s;
            first_s = std::min(first_s, packet.time_s);
        }
        const double known_s = std::min(measured_s, packets_.back().time_s - first_s);
        known_rad = kTurn_rad * known_s / streaming_.context_s;
    }
    const double enough_rad = std::min(streaming_.min_known_rad, kEnoughOfView * view_rad_);
    return known_rad >= enough_rad - kPacketEnd_rad;
}

/// Selects the image columns: all columns in and beside the sector, and a fraction of the others.
/// All sectors have the same image size, unless late packets widen a sector. Returns false if the
/// image spans the turn.
bool StreamingSegmenter::mapWindow(const Sweep& sector) {
    const int columns = filter_.options().columns;
    const Sweep& latest = *packets_.back().sweep;
    const double beside_rad = streaming_.window_rad + (latest.to_rad - latest.from_rad);
    // If the motion is unknown, nothing ahead needs narrow columns.
    const bool has_motion = packets_.back().pose || turn_motion_.since(1);
    const bool has_ahead = has_motion || streaming_.skip_ahead_rad < beside_rad;
    const double usual_rad =
        std::max(streaming_.sector_rad, sector.to_rad - sector.from_rad) + beside_rad;
    const double width_rad = usual_rad + (has_ahead ? beside_rad : kMargin_rad);
    const int group = streaming_.keep_every > 0 ? streaming_.keep_every : kEmptyColumns;
    const int groups = (columns + group - 1) / group;
    const double group_rad = kTurn_rad * group / columns;
    const double stretch = std::ceil(width_rad / group_rad) + 1;  // not limited for late packets
    if (stretch >= groups) return false;
    const int count = static_cast<int>(stretch);
    const double end_rad = sector.to_rad + (has_ahead ? beside_rad : kMargin_rad);
    const auto first_rad = static_cast<float>(std::remainder(width_rad - end_rad, kTurn_rad));
    mapColumns(columns, group, nearestColumn(first_rad, columns) / group, count, columns_);
    return true;
}

/// Labels the sector, and keeps the context for later sectors.
const SegmentationResult& StreamingSegmenter::judge() {
    const bool is_upright = postureOf(tilt(), filter_.sensor()) == Posture::Upright;
    const std::optional<Sweep>& sweep = packets_.back().sweep;
    if (sweep && is_upright && mapWindow({start_rad_, head_rad_})) {
        const SegmentationResult& result = sector_filter_.segment(
            window_.scan, tilt(), {sector_, columns_, window_.found, latest_});
        labels_ = result.returns.label;
        found_ = sector_filter_.found();
        return result;
    }
    // The newest frame decides its pixels, so that moving obstacles leave no trail.
    const bool is_newest_first = turns_ > 1 || !sweep;
    const SegmentationResult& result = is_newest_first
                                           ? filter_.segment(window_.scan, tilt(), sector_)
                                           : filter_.segment(window_.scan, tilt());
    labels_.assign(result.returns.label.begin(),
                   result.returns.label.begin() + static_cast<std::ptrdiff_t>(sector_.size()));
    found_.assign(sector_.size(), {});
    for (std::size_t i = 0; i < found_.size(); ++i) found_[i].region = labels_[i];
    return result;
}

/// Stores the results of the sector's packets, which become context.
void StreamingSegmenter::keepFound() {
    forgetThinned();
    auto from = found_.begin();
    for (std::size_t i = packets_.size() - open_; i < packets_.size(); ++i) {
        std::vector<ContextReturn>& found = packets_[i].all.found;
        const auto to = from + static_cast<std::ptrdiff_t>(found.size());
        std::copy(from, to, found.begin());
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
    if (first_open == 0) turn_motion_.forget();  // first sector, or first sector after a silence

    // The sector's returns come first, and so do its labels.
    sector_.clear();
    sweeps_.clear();
    for (std::size_t i = first_open; i < packets_.size(); ++i) {
        appendReturns(packets_[i].all.scan, sector_);
        if (packets_[i].sweep) sweeps_.push_back(*packets_[i].sweep);
    }
    sector_.beams = last.all.scan.beams;
    window_.clear();
    appendReturns(sector_, window_.scan);
    window_.scan.beams = sector_.beams;
    window_.found.resize(sector_.size());
    moved_.clear();
    pending_first_ = pending_end_ = 0;
    for (std::size_t i = 0; i < first_open; ++i) addContext(packets_[i], sector);
    addThinned(0, 0);
    locateInView(filter_.sensor(), moved_.scan);
    latest_ = window_.scan.size();
    window_.append(moved_, 0, moved_.scan.size());

    const SegmentationResult& result = judge();
    keepFound();
    if (last.sweep && streaming_.estimate_motion_from_ground) {
        turn_motion_.add(sector_, labels_, head_rad_);
    }
    const bool is_doubtful = !knowsEnough();
    if (is_doubtful) {
        for (std::size_t i = 0; i < labels_.size(); ++i) {
            const bool is_in_zone = sector_.range_m[i] <= filter_.options().zone_m;
            if (labels_[i] == Label::Rou && is_in_zone) labels_[i] = Label::Roi;
        }
    }
    const bool turns = last.sweep.has_value();
    const std::optional<Sweep>& oldest = packets_.front().sweep;
    const bool has_turn = turns
                              ? oldest && oldest->from_rad < head_rad_ - kTurn_rad + kPacketEnd_rad
                              : first_open > 0;
    ++sectors_;
    open_ = 0;
    take_({sector_, labels_, turns ? std::optional<Sweep>(sector) : std::nullopt,
           first.first_time_s, last.time_s, has_turn, is_doubtful, is_cut, result, &sweeps_,
           last.measured_s, offsets_, last.sensor_time_s});
}

}  // namespace hagen::live
