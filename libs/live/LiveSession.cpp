#include <hagen/base/NumberText.h>
#include <hagen/base/OutputPath.h>
#include <hagen/base/ProcessCost.h>
#include <hagen/live/LiveSession.h>
#include <hagen/live/Priority.h>
#include <hagen/sensors/CaptureFile.h>
#include <hagen/sensors/VelodyneModel.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <ctime>
#include <exception>
#include <optional>
#include <stdexcept>
#include <thread>
#include <utility>
#include <vector>

#include "live/LiveSensor.h"
#include "live/Recorder.h"
#include "live/SectorFigures.h"
#include "live/StatsFile.h"

namespace hagen::live {
namespace {

constexpr std::size_t kQueue = 4096;  // packets: seconds
constexpr double kSilence_s = 1.0;    // is told
constexpr double kFlush_s = 0.02;     // without packets; the sector in progress gets its labels
constexpr double kStatus_s = 0.5;
// Directions are known if a whole turn is at most 0.3 s old when they are looked at, every 0.05 s.
// Packets that waited for longer than that leaves are not labelled, up to one that is nearly new,
// so that what comes then is.
constexpr double kTooOld_s = 0.15, kNew_s = 0.05;
constexpr int kKeepsUp = 4;  // statuses in a row without such packets: this is over

std::string nameOf(const LiveOptions& options) {
    if (options.sensor_json.empty()) return "a " + options.model;
    return "the Ouster of " + options.sensor_json.string();
}

double processCpu_s() {
    return static_cast<double>(std::clock()) / static_cast<double>(CLOCKS_PER_SEC);
}

double threadCpu_s() { return std::chrono::duration<double>(base::threadCpuTime()).count(); }

/// Which of the addresses that send packets of the sensor's model is the sensor's.
class SensorAddress {
 public:
    /// Whether a packet from this address is of the sensor. One that sends is not silent, even if
    /// its packets are of no use.
    bool take(std::uint32_t ip, double arrival_s);
    /// None: nothing has come.
    std::optional<std::uint32_t> ip() const {
        return own_.empty() ? std::nullopt : std::optional(own_[current_]);
    }

 private:
    bool choose(std::uint32_t ip, bool is_silent);

    /// Beyond, nothing takes the sensor's place: those not seen before may be any.
    static constexpr std::size_t kMost = 64;

    /// Those that the sensor had, in their order: it may come back with another one.
    std::vector<std::uint32_t> own_;
    std::size_t current_ = 0;  ///< of these
    double heard_s_ = 0;       ///< when a packet from that one came last
    /// Those that sent while the sensor did, too: of other sensors, which never become ours.
    std::vector<std::uint32_t> others_;
};

bool SensorAddress::take(std::uint32_t ip, double arrival_s) {
    const bool is_silent = arrival_s - heard_s_ >= kSilence_s;
    const bool is_own = choose(ip, is_silent);
    if (is_own) heard_s_ = arrival_s;
    return is_own;
}

bool SensorAddress::choose(std::uint32_t ip, bool is_silent) {
    if (own_.empty()) own_.push_back(ip);
    if (ip == own_[current_]) return true;
    if (std::find(others_.begin(), others_.end(), ip) != others_.end()) return false;
    const auto own = std::find(own_.begin(), own_.end(), ip);
    if (own == own_.end()) {
        if (own_.size() + others_.size() >= kMost) return false;
        (is_silent ? own_ : others_).push_back(ip);
        if (is_silent) current_ = own_.size() - 1;
        return is_silent;
    }
    // Two that both send are two sensors: ours is the one that came first.
    const auto at = static_cast<std::size_t>(own - own_.begin());
    const std::size_t later = std::max(at, current_);
    current_ = std::min(at, current_);
    if (is_silent) {
        current_ = at;
    } else {
        others_.push_back(own_[later]);
        own_.erase(own_.begin() + static_cast<std::ptrdiff_t>(later));
    }
    return own_[current_] == ip;
}

/// What becomes of the packets of a sensor.
class Session {
 public:
    Session(const LiveOptions& options, const LiveListener& listener, bool is_live);

    void take(const Packet& packet);
    /// The same for one that waited for too long: it is not labelled.
    void leaveOut(const Packet& packet);
    /// Packets that nobody will label. Any thread may call it.
    void lose(std::size_t packets) { lost_ += packets; }
    /// Called by the thread that receives, with each datagram.
    void record(const Packet& packet) {
        if (recorder_) recorder_->add(packet);
    }
    /// Lets a thread go that waits in record().
    void endRecording() {
        if (recorder_) recorder_->close();
    }
    /// Tells silence, shows the status; if the sensor is silent, ends the sector in progress.
    /// `is_idle`: no packet waits.
    void look(bool is_idle);
    LiveReport finish(double start_cpu_s);

 private:
    bool isOfSensor(const Packet& packet);
    void recordPose(const Packet& packet, const live::SensorMotion& motion);
    void tellRecording();
    void tell(const live::LabelledSector& sector);
    void tellEmptiness(const Scan& returns);
    void tellChanges();
    void tellUncertain();
    void tellSilence(double now_s);
    bool tellBehind();
    void tellReturn();
    void copyCounts();
    void showStatus(double now_s);

    const LiveOptions& options_;
    const LiveListener& listener_;
    LiveReport report_;
    std::unique_ptr<LiveSensor> sensor_;
    std::optional<SectorFigures> figures_;
    std::unique_ptr<Recorder> recorder_;

    double start_s_, status_s_, last_packet_s_ = 0, last_taken_s_ = 0;  ///< of the sensor, of all
    double last_return_s_ = 0;
    SensorAddress address_;
    std::size_t uncertain_ = 0, restarts_ = 0;  ///< those that were told
    bool is_uncertain_ = false;
    bool is_flushed_ = true, is_silent_ = false, is_empty_ = false, is_recording_told_ = false;
    bool is_slow_recording_told_ = false, has_place_ = false;
    std::size_t foreign_ip_ = 0;
    std::size_t left_out_ = 0, left_out_before_ = 0;  ///< until now, until the last status
    int keeps_up_ = kKeepsUp;                         ///< statuses
    std::atomic<std::size_t> lost_ = 0;
};

Session::Session(const LiveOptions& options, const LiveListener& listener, bool is_live)
    : options_(options), listener_(listener), start_s_(steadyNow_s()), status_s_(start_s_) {
    sensor_ = makeLiveSensor(options, [this](const live::LabelledSector& sector) { tell(sector); });
    const live::StreamingSegmenter& segmenter = sensor_->segmenter();
    figures_.emplace(segmenter.sensor(), options_.settings.mount, report_);
    listener_.begin(segmenter.sensor(), segmenter.options());
    if (options.recording.file.empty()) return;
    recorder_ = std::make_unique<Recorder>(options.recording, bool{listener_.motion}, !is_live);
}

void Session::tell(const live::LabelledSector& sector) {
    figures_->take(sector, steadyNow_s());
    listener_.sector(sector);
    tellEmptiness(sector.returns);
}

/// A covered window looks like open air.
void Session::tellEmptiness(const Scan& returns) {
    const bool is_empty = std::all_of(returns.range_m.begin(), returns.range_m.end(),
                                      [](float range_m) { return std::isnan(range_m); });
    if (!is_empty || last_return_s_ == 0) last_return_s_ = last_packet_s_;
    if (is_empty_ && !is_empty) listener_.remark("there are returns again");
    if (!is_empty) is_empty_ = false;
    if (is_empty_ || last_packet_s_ - last_return_s_ <= kSilence_s) return;
    is_empty_ = true;
    listener_.remark("packets come, but none had a return for " + base::fixedText(kSilence_s, 0) +
                     " s: nothing is in range, or the sensor's window is covered");
}

/// Packets of the same model from another address are foreign, unless it is the sensor's new one.
bool Session::isOfSensor(const Packet& packet) {
    const std::uint32_t before = address_.ip().value_or(packet.from_ip);
    if (!address_.take(packet.from_ip, packet.arrival_s)) {
        ++foreign_ip_;
        return false;
    }
    if (before != packet.from_ip) {
        listener_.remark("the sensor is now at " + sensors::ipText(packet.from_ip) +
                         ", no longer at " + sensors::ipText(before));
        sensor_->flush();  // no sector has returns of both
    }
    return true;
}

void Session::take(const Packet& packet) {
    ++report_.datagrams;
    last_taken_s_ = packet.arrival_s;
    if (listener_.motion) {
        const live::SensorMotion motion = listener_.motion(packet.arrival_s);
        sensor_->move(motion);
        if (recorder_) recordPose(packet, motion);
    }
    if (sensor_->isToldByAddress(packet) && !isOfSensor(packet)) return;
    if (sensor_->add(packet)) {
        last_packet_s_ = packet.arrival_s;
        is_flushed_ = false;
        tellChanges();
    } else {
        tellUncertain();
    }
}

/// The pose of the vehicle, as rawlog-segment puts it together with the mount of the settings.
/// Without a place, that is 0: the tilt is what labels need. Once places have come, poses without
/// one are left out: a map would be torn.
void Session::recordPose(const Packet& packet, const live::SensorMotion& motion) {
    Eigen::Isometry3d map_from_sensor = Eigen::Isometry3d::Identity();
    if (motion.map_from_sensor) {
        has_place_ = true;
        map_from_sensor = *motion.map_from_sensor;
    } else if (motion.attitude && !has_place_) {
        map_from_sensor.linear() = levelFromSensor(*motion.attitude).cast<double>();
    } else {
        return;
    }
    map_from_sensor.linear() *= levelFromSensor(options_.settings.mount).cast<double>().transpose();
    recorder_->addPose(packet.time_ns, map_from_sensor);
}

void Session::leaveOut(const Packet& packet) {
    last_taken_s_ = packet.arrival_s;
    if (!sensor_->isData(packet)) return;
    if (sensor_->isToldByAddress(packet) && !isOfSensor(packet)) return;
    // Nobody looked for returns meanwhile.
    if (last_return_s_ > 0) last_return_s_ += packet.arrival_s - last_packet_s_;
    last_packet_s_ = packet.arrival_s;
    ++left_out_;
    tellReturn();
    if (report_.datagrams == 0) return;  // what came while the session began says nothing
    if (keeps_up_ >= kKeepsUp) {
        listener_.remark("labelling is too slow: packets that waited are left out (\"dropped\")");
    }
    keeps_up_ = 0;
}

/// After a packet was left out: perhaps since the mode of an Ouster is not that of its metadata.
void Session::tellUncertain() {
    const LiveSensor::Counts counts = sensor_->counts();
    if (counts.uncertain == uncertain_) return;
    uncertain_ = counts.uncertain;
    const bool is_restarted = counts.restarts > restarts_;
    restarts_ = counts.restarts;
    if (is_uncertain_ && !is_restarted) return;
    is_uncertain_ = true;
    listener_.remark(is_restarted
                         ? "the sensor was started again; it is labelled once it turns with "
                           "the columns of " +
                               options_.sensor_json.string()
                         : "the sensor does not turn with the columns of " +
                               options_.sensor_json.string() +
                               ": its packets are left out. Is it in another mode?");
}

/// After a packet was taken.
void Session::tellChanges() {
    if (is_uncertain_) {
        is_uncertain_ = false;
        listener_.remark("the sensor turns with the columns of its metadata again");
    }
    tellReturn();
    const std::size_t changes = sensor_->counts().mode_changes;
    if (changes == report_.mode_changes) return;
    report_.mode_changes = changes;
    listener_.remark(sensor_->isDual() ? "the sensor sends two returns per firing now"
                                       : "the sensor sends one return per firing now");
}

/// After a silence.
void Session::tellReturn() {
    if (!is_silent_) return;
    is_silent_ = false;
    last_return_s_ = last_packet_s_;
    listener_.remark("packets come again");
}

void Session::copyCounts() {
    const LiveSensor::Counts counts = sensor_->counts();
    LiveReport& r = report_;
    r.packets = counts.packets;
    r.lost = counts.lost;
    r.late = counts.late;
    r.too_late = counts.too_late;
    r.repeated = counts.repeated;
    r.wrong_size = counts.wrong_size;
    r.position = counts.position;
    r.foreign = counts.foreign + foreign_ip_;
    r.unsound = counts.unsound;
    r.unsound_blocks = counts.unsound_blocks;
    r.uncertain = counts.uncertain;
    r.interruptions = counts.interruptions;
    r.scans = counts.scans;
    r.dropped = left_out_ + lost_;
    figures_->update(steadyNow_s());
    r.seconds = steadyNow_s() - start_s_;
}

void Session::showStatus(double now_s) {
    copyCounts();
    LiveStatus status = figures_->status(now_s - status_s_, sensor_->turns());
    status.is_silent = is_silent_;
    const bool is_behind = tellBehind();
    if (sensor_->turns() && !is_silent_ && !is_behind) {
        if (const auto change = figures_->rateChange()) {
            listener_.remark("the sensor turns " + base::fixedText(change->now, 1) +
                             " times per second now, " + base::fixedText(change->before, 1) +
                             " before");
        }
    }
    figures_->next();
    status_s_ = now_s;
    listener_.status(report_, status);
}

/// Whether packets were left out since the last status: what is left of a turn tells no speed.
bool Session::tellBehind() {
    const bool is_behind = left_out_ > left_out_before_;
    left_out_before_ = left_out_;
    if (!is_behind && keeps_up_ < kKeepsUp && ++keeps_up_ == kKeepsUp) {
        listener_.remark("labelling keeps up again");
    }
    return is_behind;
}

void Session::tellSilence(double now_s) {
    const double silent_s = now_s - (last_packet_s_ > 0 ? last_packet_s_ : start_s_);
    if (is_silent_ || silent_s <= kSilence_s) return;
    is_silent_ = true;
    ++report_.silences;
    copyCounts();
    listener_.remark(report_.packets > 0 ? "no valid packets of the sensor for " +
                                               base::fixedText(kSilence_s, 0) + " s"
                                         : "no packet of " + nameOf(options_) + " has come yet");
}

void Session::look(bool is_idle) {
    const double now_s = steadyNow_s();
    // Packets that wait for a busy processor are no silence of the sensor; those that others send
    // to the port do not shorten it.
    const double heard_s = is_idle ? now_s : last_taken_s_;
    if (report_.datagrams > 0 && !is_flushed_ && heard_s - last_packet_s_ > kFlush_s) {
        sensor_->flush();
        is_flushed_ = true;
    }
    tellSilence(heard_s);
    if (recorder_) tellRecording();
    figures_->countDirections(now_s);
    if (now_s - status_s_ >= kStatus_s) showStatus(now_s);
}

void Session::tellRecording() {
    if (is_recording_told_) return;
    const std::string failure = recorder_->failure();
    if (!failure.empty()) {
        is_recording_told_ = true;
        listener_.remark("recording stopped: " + failure);
    } else if (recorder_->leftOut() > 0 && !is_slow_recording_told_) {
        is_slow_recording_told_ = true;
        listener_.remark("the disk is too slow: datagrams are missing in the recording");
    }
}

LiveReport Session::finish(double start_cpu_s) {
    sensor_->flush();
    sensor_->finish();
    copyCounts();
    report_.filter_cpu_s = threadCpu_s() - start_cpu_s;
    if (recorder_) report_.recorded = recorder_->finish();
    return report_;
}

}  // namespace

std::string liveModels(const std::string& separator) {
    std::string names;
    for (const char* name : {"VLP-16", "Puck Hi-Res", "HDL-32E", "VLP-32C", kHdl64, kLivox}) {
        names += (names.empty() ? "" : separator) + name;
    }
    return names;
}

void checkLive(const LiveOptions& options) {
    if (!options.sensor_json.empty()) {
        if (!options.model.empty()) {
            throw std::runtime_error("an Ouster's metadata name its model: leave out --model");
        }
        if (!options.calibration.empty()) {
            throw std::runtime_error(options.calibration.string() + ": only an HDL-64E has one");
        }
        return;
    }
    const bool is_hdl64 = options.model == kHdl64;
    if (options.model != kLivox && !is_hdl64) {
        try {
            sensors::velodyneModel(options.model);
        } catch (const std::invalid_argument&) {
            throw std::runtime_error("'" + options.model +
                                     "' cannot be labelled live; supported are " + liveModels() +
                                     ". An Ouster needs its metadata: --sensor-json FILE");
        }
    }
    if (is_hdl64 && options.calibration.empty()) {
        throw std::runtime_error("an HDL-64E needs its calibration: --calibration FILE");
    }
    if (!is_hdl64 && !options.calibration.empty()) {
        throw std::runtime_error(options.calibration.string() + ": only an HDL-64E has one");
    }
}

LiveReport runLive(PacketSource& source, const LiveOptions& options, const LiveListener& listener) {
    checkLive(options);
    std::vector<std::filesystem::path> inputs = options.settings.files;
    inputs.insert(inputs.end(), {options.replay, options.calibration, options.sensor_json});
    const RecordingOptions& recording = options.recording;
    std::vector<std::filesystem::path> outputs{recording.file, options.stats};
    if (listener.motion) outputs.push_back(recording.posesFile());
    base::checkApart(outputs, inputs);
    std::optional<base::OutputPath> stats;
    if (!options.stats.empty()) stats.emplace(options.stats, base::kFile, options.overwrite);
    Session session(options, listener, source.isLive());
    const double start_s = steadyNow_s(), process_s = processCpu_s(), cpu_s = threadCpu_s();

    PacketQueue queue(kQueue);
    std::atomic<bool> is_at_end = false;
    std::exception_ptr failure;
    std::thread receiver([&] {
        try {
            Packet packet;
            while (!is_at_end) {
                const PacketSource::Next next = source.next(packet);
                if (next == PacketSource::Next::End) break;
                if (next == PacketSource::Next::Nothing) continue;
                session.record(packet);
                if (!source.isLive()) {
                    queue.pushOrWait(packet);
                } else if (!queue.push(packet)) {
                    session.lose(1);
                }
            }
        } catch (...) {
            failure = std::current_exception();
        }
        queue.close();
    });
    const auto stop = [&] {
        is_at_end = true;
        queue.close();
        session.endRecording();
        if (receiver.joinable()) receiver.join();
    };
    letOthersGoFirst();
    try {
        Packet packet;
        bool is_behind = false;
        while (listener.keep_going() && steadyNow_s() - start_s < options.duration_s) {
            const auto popped = queue.pop(packet, std::chrono::milliseconds(10));
            if (popped == PacketQueue::Popped::Closed) break;
            if (popped == PacketQueue::Popped::Packet) {
                const double waited_s = steadyNow_s() - packet.arrival_s;
                is_behind = source.isLive() && waited_s > (is_behind ? kNew_s : kTooOld_s);
                if (is_behind) {
                    session.leaveOut(packet);
                } else {
                    session.take(packet);
                }
            }
            session.look(popped == PacketQueue::Popped::Nothing);
        }
    } catch (...) {
        stop();
        throw;
    }
    stop();
    // Those that still wait are labelled by nobody.
    session.lose(source.isLive() ? queue.size() : 0);
    LiveReport report = session.finish(cpu_s);
    report.process_cpu_s = processCpu_s() - process_s;
    if (stats) {
        try {
            writeStats(report, options, listener, *stats);
        } catch (const std::exception& e) {  // the session has been flown all the same
            report.stats_failure = e.what();
        }
    }
    if (failure) {
        if (!report.stats_failure.empty()) listener.remark(report.stats_failure);
        std::rethrow_exception(failure);
    }
    return report;
}

}  // namespace hagen::live
