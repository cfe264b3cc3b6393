#include "live/autopilot/AutopilotLink.h"
#include <hagen/live/PacketQueue.h>
#include "live/autopilot/GroundBelow.h"
#include "live/mavlink/Parser.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <new>
#include <thread>

namespace hagen::live {
namespace {

/// The senders of received messages, to explain a missing attitude.
class Senders {
 public:
    void add(const mavlink::Frame& frame) {
        constexpr std::size_t kMaxSenders = 16;
        if (senders_.size() == kMaxSenders && senders_.count({frame.system, frame.component}) == 0)
            return;
        Sent& sent = senders_[{frame.system, frame.component}];
        sent.version = frame.version;
        sent.has_heartbeat = sent.has_heartbeat || frame.id == mavlink::Heartbeat::kId;
        sent.has_attitude = sent.has_attitude || frame.id == mavlink::Attitude::kId ||
                            frame.id == mavlink::AttitudeQuaternion::kId;
    }
    /// What each sender sends, and how to receive its attitude as that of vehicle `system`. Empty
    /// without senders.
    std::string text(std::uint8_t system) const {
        std::string text;
        for (const auto& [sender, sent] : senders_) {
            const bool is_autopilot = sender.second == mavlink::kComponentAutopilot;
            text += (text.empty() ? "system " : "; system ") + std::to_string(sender.first);
            if (!is_autopilot) text += ", component " + std::to_string(sender.second);
            text += ": MAVLink " + std::to_string(sent.version) +
                    (sent.has_attitude ? ", ATTITUDE" : ", no ATTITUDE") +
                    (sent.has_heartbeat ? ", HEARTBEAT" : ", no HEARTBEAT");
            if (!is_autopilot) continue;
            std::string advice;
            const auto advise = [&](const std::string& what) {
                advice += (advice.empty() ? "" : ", ") + what;
            };
            if (sender.first != system) advise("--mavlink-system " + std::to_string(sender.first));
            if (sent.version == 1) advise("SERIALn_PROTOCOL = 2 (PX4: MAV_PROTO_VER = 2)");
            if (!sent.has_attitude) advise("SRn_EXTRA1 = 50 (PX4: MAV_n_MODE = Onboard)");
            if (!advice.empty()) text += " [set " + advice + "]";
        }
        return text;
    }

 private:
    struct Sent {
        int version = 2;  ///< of MAVLink, of the latest message
        bool has_attitude = false, has_heartbeat = false;
    };
    std::map<std::pair<std::uint8_t, std::uint8_t>, Sent> senders_;  ///< by system and component
};

constexpr double kPeriod_s = 0.05;       // OBSTACLE_DISTANCE period
constexpr std::size_t kOthersEvery = 2;  // periods per 3D and ground message
constexpr std::size_t kHeartbeatEvery = 20;
constexpr double kMaxMessageWait_s = 0.01;
constexpr std::size_t kMaxAtOnce = 1000;  // datagrams; a flood must not delay sending
constexpr double kAttitudeWithin_s = 3;   // time before a missing attitude is reported
constexpr double kMaxBehind_s = 0.5;      // maximum delay before periods are skipped

}  // namespace

/// The sending thread, and the state that it shares with other threads.
class AutopilotLink::Work {
 public:
    Work(Settings settings, Remark remark)
        : settings_(std::move(settings)),
          remark_(std::move(remark)),
          peer_(mavlink::Peer::open(settings_.peer)),
          motion_(settings_.is_simulated) {}
    ~Work() { stop(); }

    void begin(const SensorModel& sensor, Limits limits) {
        limits_ = limits;
        limits_.nearest_m = sensor.min_range_m;
        distances_.emplace(sensor, settings_.directions);
        start_s_ = attitude_report_s_ = steadyNow_s();
        thread_ = std::thread([this] { work(); });
    }

    const char* state() const { return state_; }
    Directions directions() const {
        const std::lock_guard lock(mutex_);
        return directions_;
    }

    void stop() {
        is_at_end_ = true;
        if (thread_.joinable()) thread_.join();
    }

    void take(const LabelledSector& sector) {
        const auto below = sector.is_doubtful || !settings_.has_ground
                               ? std::nullopt
                               : groundBelow(sector.result.ground, vehicleFromSensor());
        const std::lock_guard lock(mutex_);
        distances_->take(sector);
        if (below) {
            below_m_ = *below;
            below_s_ = sector.first_time_s;
        }
    }

    SensorMotion motionAt(double time_s) const {
        const std::lock_guard lock(mutex_);
        const auto pose = motion_.at(time_s);
        if (!pose) return {};
        const Eigen::Matrix3d mount = settings_.directions.body_from_sensor.linear();
        const Eigen::Matrix3f level = (levelFromVehicle(*pose) * mount).cast<float>();
        SensorMotion motion;
        motion.attitude = {std::atan2(level(2, 1), level(2, 2)),
                           std::asin(std::clamp(-level(2, 0), -1.0f, 1.0f))};
        if (pose->place_m) {
            Eigen::Isometry3d map_from_sensor = Eigen::Isometry3d::Identity();
            map_from_sensor.linear() = pose->map_from_vehicle.toRotationMatrix() * mount;
            map_from_sensor.translation() = *pose->place_m;
            motion.map_from_sensor = map_from_sensor;
        }
        return motion;
    }

    Counts counts() const {
        const std::lock_guard lock(mutex_);
        const auto& c = parser_.counts();
        return {{"obstacle_distance", sent_distance_},
                {"obstacle_distance_3d", sent_3d_},
                {"distance_sensor", sent_below_},
                {"heartbeat", sent_heartbeat_},
                {"all_unknown", all_unknown_},
                {"not_sent", not_sent_},
                {"out_of_memory", out_of_memory_},
                {"stalls", stalls_},
                {"peer_troubles", troubles_},
                {"received", c.messages},
                {"attitude", attitudes_},
                {"position", places_},
                {"other_messages", others_},
                {"other_systems", foreign_},
                {"other_addresses", ignored_},
                {"mavlink_1", c.version_1},
                {"refused", refused_},
                {"bad_checksum", c.bad_checksum},
                {"incompatible", c.incompatible},
                {"signed", c.is_signed},
                {"lost", c.lost},
                {"skipped_bytes", c.skipped_bytes},
                {"clock_restarts", motion_.restarts()}};
    }

 private:
    Eigen::Matrix3f vehicleFromSensor() const {
        return settings_.directions.body_from_sensor.linear().cast<float>();
    }

    void work() {
        double next_s = start_s_;
        for (std::size_t period = 0; !is_at_end_; ++period) {
            attempt([&] { sendPeriod(period); });
            next_s = std::max(next_s + kPeriod_s, steadyNow_s() - kMaxBehind_s);
            double rest_s = 0;
            do {  // receives even if late, because unread messages become stale
                rest_s = std::max(next_s - steadyNow_s(), 0.0);
                attempt([&] { receiveAll(rest_s); });
            } while (!is_at_end_ && rest_s > 0);
            attempt([&] { reportPeer(); });
            attempt([&] { reportAttitude(); });
            state_ = !trouble_.empty()  ? "unreachable"
                     : is_stalled_      ? "without labels"
                     : !knows_attitude_ ? "waiting"
                     : *knows_attitude_ ? "ok"
                                        : "without attitude";
        }
        attempt([&] { send(obstacleDistance({}, limits_, steadyNow_s()), sent_distance_); });
    }

    /// Skips and counts a step that is out of memory. The autopilot notices missing messages.
    template <class Step>
    void attempt(const Step& step) {
        try {
            step();
        } catch (const std::bad_alloc&) {
            count(out_of_memory_);
        }
    }

    void sendPeriod(std::size_t period) {
        const double time_s = steadyNow_s();
        std::optional<float> below_m;
        // Copies the state, so that computing directions does not block labelling.
        std::unique_lock lock(mutex_);
        const SectorDistances distances = *distances_;
        const VehicleMotion motion = motion_;
        if (time_s - below_s_ <= settings_.directions.stale_s) below_m = below_m_;
        lock.unlock();
        const Directions directions =
            distances.at(time_s, [&](double at_s) { return motion.at(at_s); });
        lock.lock();
        directions_ = directions;
        lock.unlock();
        const std::optional<VehiclePose> pose = motion.at(time_s);
        const double latest_s = distances.latest_s();
        watch(latest_s, time_s);
        const bool is_all_unknown = std::all_of(
            directions.begin(), directions.end(),
            [](const Direction& each) { return each.state == DirectionState::Unknown; });
        if (send(obstacleDistance(directions, limits_, time_s), sent_distance_) && is_all_unknown) {
            count(all_unknown_);
        }
        if (period % kOthersEvery == 0) {
            const auto obstacles = numbers_.nearest(directions, settings_.nearest, pose);
            for (const auto& message : obstacleDistances3d(obstacles, pose, limits_, time_s)) {
                send(message, sent_3d_);
            }
            if (below_m) send(distanceBelow(*below_m, limits_, time_s), sent_below_);
        }
        if (period % kHeartbeatEvery == 0) {
            const bool has_begun = std::isfinite(latest_s);
            send(heartbeat(is_stalled_ ? mavlink::kStateCritical
                           : has_begun ? mavlink::kStateActive
                                       : mavlink::kStateBoot),
                 sent_heartbeat_);
        }
    }

    /// Reports whether labelling has stalled.
    void watch(double latest_s, double time_s) {
        const bool is_stalled =
            std::isfinite(latest_s) && time_s - latest_s > settings_.directions.stale_s;
        if (is_stalled == is_stalled_) return;
        is_stalled_ = is_stalled;
        if (is_stalled) count(stalls_);
        remark_(is_stalled ? "MAVLink: no labels for 0.3 s, sending all directions as unknown"
                           : "MAVLink: sending directions again");
    }

    void receiveAll(double longest_s) {
        for (std::size_t n = 0; n < kMaxAtOnce && receive(n == 0 ? longest_s : 0); ++n) {
        }
    }

    /// Returns whether bytes were received.
    bool receive(double longest_s) {
        std::array<std::uint8_t, 65536>& buffer = buffer_;
        const std::size_t size =
            peer_->receive(buffer.data(), buffer.size(), std::min(longest_s, kMaxMessageWait_s));
        if (size == 0) return false;
        const double arrival_s = steadyNow_s();
        const std::lock_guard lock(mutex_);
        const auto take = [&](const mavlink::Frame& frame) { takeFrame(frame, arrival_s); };
        parser_.add(buffer.data(), size, take);
        if (peer_->hasDatagrams()) parser_.end(take);
        return true;
    }

    void takeFrame(const mavlink::Frame& frame, double arrival_s) {
        if (attitudes_ == 0) senders_.add(frame);
        if (frame.version == 1) return;
        if (frame.system != settings_.system || frame.component != mavlink::kComponentAutopilot) {
            ++foreign_;
            return;
        }
        switch (motion_.take(frame, arrival_s)) {
            case VehicleMotion::Taken::Attitude:
                ++attitudes_;
                break;
            case VehicleMotion::Taken::Place:
                ++places_;
                break;
            case VehicleMotion::Taken::Other:
                ++others_;
                break;
            case VehicleMotion::Taken::Refused:
                ++refused_;
                break;
        }
    }

    template <class Message>
    bool send(const Message& message, std::size_t& sent) {
        mavlink::Frame frame = mavlink::frameOf(message);
        frame.sequence = sequence_++;
        frame.system = settings_.system;
        frame.component = mavlink::kComponentObstacleAvoidance;
        const bool is_sent = peer_->send(encode(frame, Message::kBytes));
        count(is_sent ? sent : not_sent_);
        return is_sent;
    }

    void count(std::size_t& number) {
        const std::lock_guard lock(mutex_);
        ++number;
    }

    void reportPeer() {
        const std::string trouble = peer_->trouble();
        if (trouble.empty() == trouble_.empty()) return;
        remark_("MAVLink: " +
                (trouble.empty() ? peer_->name() + ": connection restored" : trouble));
        if (!trouble.empty()) count(troubles_);
        trouble_ = trouble;
    }

    /// Reports whether the attitude is known and, until it is, changes of what is received instead.
    void reportAttitude() {
        const double time_s = steadyNow_s();
        bool is_known = false;
        std::string instead;
        {
            const std::lock_guard lock(mutex_);
            is_known = motion_.at(time_s).has_value();
            ignored_ = peer_->ignored().datagrams;
            if (attitudes_ == 0) instead = received();
        }
        const bool is_late = time_s - attitude_report_s_ >= kAttitudeWithin_s;
        if (is_known == knows_attitude_.value_or(false) &&
            (!is_late || instead.empty() || instead == instead_)) {
            return;
        }
        const std::string vehicle = "vehicle " + std::to_string(settings_.system);
        remark_(is_known ? "MAVLink: receiving the attitude of " + vehicle
                         : "MAVLink: no attitude from " + vehicle + ", scans are not levelled" +
                               instead);
        knows_attitude_ = is_known;
        instead_ = instead;
        attitude_report_s_ = time_s;
    }

    std::string received() const {
        std::string text = senders_.text(settings_.system);
        if (text.empty()) {
            text = parser_.counts().skipped_bytes > 0 ? "no MAVLink message" : "nothing";
        }
        text = "; received from " + peer_->name() + ": " + text;
        const std::string other = peer_->ignored().sender;
        if (other.empty()) return text;
        const std::uint16_t port = settings_.peer.local_port;
        return text + "; ignored from " + other + " [set --mavlink udp:" + other +
               (port > 0 ? ":" + std::to_string(port) : "") + "]";
    }

    const Settings settings_;
    const Remark remark_;
    const std::unique_ptr<mavlink::Peer> peer_;
    Limits limits_;
    double start_s_ = 0;

    // Used only by the sending thread.
    ObstacleNumbers numbers_;
    std::array<std::uint8_t, 65536> buffer_;
    std::uint8_t sequence_ = 0;
    bool is_stalled_ = false;
    std::optional<bool> knows_attitude_;
    double attitude_report_s_ = 0;
    std::string trouble_, instead_;

    mutable std::mutex mutex_;  // guards all members below
    std::optional<SectorDistances> distances_;
    Directions directions_;  ///< sent last
    VehicleMotion motion_;
    mavlink::Parser parser_;
    Senders senders_;
    float below_m_ = 0;
    double below_s_ = -std::numeric_limits<double>::infinity();
    std::size_t sent_distance_ = 0, sent_3d_ = 0, sent_below_ = 0, sent_heartbeat_ = 0;
    std::size_t all_unknown_ = 0, not_sent_ = 0, stalls_ = 0, troubles_ = 0;
    std::size_t out_of_memory_ = 0;
    std::size_t attitudes_ = 0, places_ = 0, others_ = 0, foreign_ = 0, refused_ = 0, ignored_ = 0;

    std::atomic<bool> is_at_end_ = false;
    std::atomic<const char*> state_ = "waiting";
    std::thread thread_;
};

AutopilotLink::AutopilotLink(Settings settings, Remark remark)
    : work_(std::make_unique<Work>(std::move(settings), std::move(remark))) {}

AutopilotLink::~AutopilotLink() = default;

void AutopilotLink::begin(const SensorModel& sensor, Limits limits) {
    work_->begin(sensor, limits);
}

void AutopilotLink::take(const LabelledSector& sector) { work_->take(sector); }

SensorMotion AutopilotLink::motionAt(double time_s) const { return work_->motionAt(time_s); }

void AutopilotLink::stop() { work_->stop(); }

AutopilotLink::Counts AutopilotLink::counts() const { return work_->counts(); }

std::string AutopilotLink::state() const { return work_->state(); }
Directions AutopilotLink::directions() const { return work_->directions(); }

}  // namespace hagen::live
