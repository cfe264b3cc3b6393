#include <hagen/base/Json.h>
#include <hagen/base/OutputPath.h>
#include <hagen/base/ProcessCost.h>
#include <hagen/captures/LivoxScans.h>
#include <hagen/captures/OusterScan.h>
#include <hagen/captures/VelodyneTurns.h>
#include <hagen/live/LiveSession.h>
#include <hagen/observations/VelodyneCalibrationFile.h>
#include <hagen/range_image/Angle.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <exception>
#include <fstream>
#include <optional>
#include <stdexcept>
#include <thread>
#include <utility>

namespace hagen::live {
namespace {

using streaming::SectorDistances;
using Taken = streaming::VelodyneStream::Taken;

constexpr std::size_t kQueue = 4096;  // packets: seconds
constexpr double kSilence_s = 1.0;    // is told
constexpr double kFlush_s = 0.02;     // without packets; the sector in progress gets its labels
constexpr double kStatus_s = 0.5;
constexpr double kDirections_s = 0.05;
constexpr double kOtherRate = 0.2;  // of the turns, is told
constexpr std::size_t kPositionBytes = 512;
constexpr const char* kLivox = "Mid-360";
constexpr const char* kHdl64 = "HDL-64E";

const observations::VelodyneModel& velodyneOf(const std::string& name) {
    return name == kHdl64 ? observations::hdl64Model() : observations::velodyneModel(name);
}

std::string nameOf(const LiveOptions& options) {
    if (options.sensor_json.empty()) return "a " + options.model;
    return "the Ouster of " + options.sensor_json.string();
}

double processCpu_s() {
    return static_cast<double>(std::clock()) / static_cast<double>(CLOCKS_PER_SEC);
}

double threadCpu_s() { return std::chrono::duration<double>(base::threadCpuTime()).count(); }

std::string fixed(double value, int decimals) {
    char text[64];
    std::snprintf(text, sizeof text, "%.*f", decimals, value);
    return text;
}

/// One sensor of either kind, and what becomes of its packets.
class Session {
 public:
    Session(const LiveOptions& options, const LiveListener& listener, bool is_live);

    void take(const Packet& packet);
    /// Tells silence, shows the status; if no packet waits, ends the sector in progress.
    void look(bool is_idle);
    LiveReport finish(double start_cpu_s);
    LiveReport& report() { return report_; }

 private:
    const streaming::StreamingSegmenter& segmenter() const {
        if (ouster_) return ouster_->segmenter();
        return velodyne_ ? velodyne_->segmenter() : livox_->segmenter();
    }
    void move(double time_s);
    void takeVelodyne(const Packet& packet);
    void takeLivox(const Packet& packet);
    void takeOuster(const Packet& packet);
    template <class Turns>
    void record(Turns& turns);
    void recordOuster();
    void flush();
    bool isOfSensor(const Packet& packet);
    void tell(const streaming::LabelledSector& sector);
    void noteNearest(const streaming::LabelledSector& sector);
    void tellChanges();
    void countDirections(double now_s);
    void copyCounts();
    void showStatus(double now_s);

    const LiveOptions& options_;
    const LiveListener& listener_;
    LiveReport report_;
    std::unique_ptr<streaming::VelodyneStream> velodyne_;
    std::unique_ptr<streaming::LivoxStream> livox_;
    std::unique_ptr<streaming::OusterStream> ouster_;
    std::optional<captures::VelodyneTurns> turns_;
    std::optional<captures::LivoxScans> scans_;
    std::unique_ptr<TurnRecorder> recorder_;
    std::optional<SectorDistances> distances_;

    double start_s_, status_s_, last_packet_s_ = 0, counted_s_ = 0;
    std::optional<std::uint32_t> sensor_ip_;
    bool is_flushed_ = true, is_silent_ = false, is_recording_told_ = false;
    std::optional<bool> is_dual_;
    std::size_t foreign_ip_ = 0;
    LatencyHistogram recent_;
    double recent_sweep_rad_ = 0, recent_first_s_ = 0, recent_last_s_ = 0, rate_told_ = 0;
    int odd_rates_ = 0;
};

Session::Session(const LiveOptions& options, const LiveListener& listener, bool is_live)
    : options_(options), listener_(listener), start_s_(steadyNow_s()), status_s_(start_s_) {
    const auto take = [this](const streaming::LabelledSector& sector) { tell(sector); };
    report_.nearest_m.fill(std::numeric_limits<float>::infinity());
    TurnRecorder::Options recording = options.recording;
    recording.waits = !is_live;
    if (!options.sensor_json.empty()) {
        ouster_ = std::make_unique<streaming::OusterStream>(
            captures::readOusterSensor(options.sensor_json), options.settings, take,
            options.streaming);
        distances_.emplace(segmenter().sensor());
        listener_.begin(segmenter().sensor(), segmenter().options());
        if (recording.file.empty()) return;
        recorder_ = std::make_unique<TurnRecorder>(recording, options.settings);
        return;
    }
    if (options.model == kLivox) {
        livox_ = std::make_unique<streaming::LivoxStream>(options.settings, take);
        distances_.emplace(livox_->segmenter().sensor());
        listener_.begin(segmenter().sensor(), segmenter().options());
        if (recording.file.empty()) return;
        scans_.emplace("livox");
        recorder_ = std::make_unique<TurnRecorder>(recording, options.settings);
        return;
    }
    std::shared_ptr<const mrpt::obs::VelodyneCalibration> calibration;
    if (!options.calibration.empty()) {
        calibration = std::make_shared<const mrpt::obs::VelodyneCalibration>(
            observations::readVelodyneCalibration(options.calibration));
    }
    const observations::VelodyneModel& model = velodyneOf(options.model);
    velodyne_ = std::make_unique<streaming::VelodyneStream>(model, options.settings, take,
                                                            options.streaming, calibration);
    distances_.emplace(velodyne_->segmenter().sensor());
    listener_.begin(segmenter().sensor(), segmenter().options());
    if (options.recording.file.empty()) return;
    turns_.emplace(model, "velodyne", calibration);
    recorder_ = std::make_unique<TurnRecorder>(recording, options.settings);
}

void Session::tell(const streaming::LabelledSector& sector) {
    const double latency_s = steadyNow_s() - sector.last_time_s;
    if (sector.is_cut) {
        ++report_.sectors_cut;
    } else {
        report_.latency.add(latency_s);
        recent_.add(latency_s);
    }
    ++report_.sectors;
    report_.returns += sector.returns.size();
    report_.roi +=
        static_cast<std::size_t>(std::count(sector.label.begin(), sector.label.end(), Label::Roi));
    if (sector.sweep) {
        if (recent_sweep_rad_ == 0) recent_first_s_ = sector.first_time_s;
        recent_last_s_ = sector.last_time_s;
        recent_sweep_rad_ += sector.sweep->to_rad - sector.sweep->from_rad;
    }
    distances_->take(sector);
    report_.sectors_doubtful += sector.is_doubtful;
    noteNearest(sector);
    listener_.sector(sector);
}

void Session::noteNearest(const streaming::LabelledSector& sector) {
    if (sector.is_doubtful) return;
    const Scan& scan = sector.returns;
    for (std::size_t i = 0; i < scan.size(); ++i) {
        if (sector.label[i] != Label::Roi) continue;
        const double clockwise_rad = -static_cast<double>(scan.azimuth_rad[i]);
        const double share = clockwise_rad / (2 * kPi) + (clockwise_rad < 0 ? 1 : 0);
        const int k = std::min(static_cast<int>(share * SectorDistances::kSectors),
                               SectorDistances::kSectors - 1);
        report_.nearest_m[k] = std::min(report_.nearest_m[k], std::hypot(scan.x_m[i], scan.y_m[i]));
    }
}

/// Packets of the same model from another address are foreign, unless the first one fell silent:
/// a sensor may come back with another address.
bool Session::isOfSensor(const Packet& packet) {
    if (!sensor_ip_) {
        sensor_ip_ = packet.from_ip;
    } else if (*sensor_ip_ != packet.from_ip) {
        if (packet.arrival_s - last_packet_s_ < kSilence_s) {
            ++foreign_ip_;
            return false;
        }
        listener_.remark("the sensor is now at " + captures::ipText(packet.from_ip) +
                         ", no longer at " + captures::ipText(*sensor_ip_));
        sensor_ip_ = packet.from_ip;
    }
    return true;
}

/// Tells the stream how the sensor moves.
void Session::move(double time_s) {
    if (!listener_.motion) return;
    const streaming::SensorMotion motion = listener_.motion(time_s);
    const auto tell = [&](auto& stream) {
        stream.setAttitude(motion.attitude);
        stream.setPose(motion.map_from_sensor);
    };
    if (velodyne_) tell(*velodyne_);
    if (livox_) tell(*livox_);
    if (ouster_) tell(*ouster_);
}

void Session::flush() {
    if (velodyne_) velodyne_->flush();
    if (livox_) livox_->flush();
    if (ouster_) ouster_->flush();
}

void Session::take(const Packet& packet) {
    ++report_.datagrams;
    move(packet.arrival_s);
    if (velodyne_) {
        takeVelodyne(packet);
    } else if (ouster_) {
        takeOuster(packet);
    } else {
        takeLivox(packet);
    }
}

void Session::takeVelodyne(const Packet& packet) {
    if (packet.bytes.size() == kPositionBytes) {
        ++report_.position;
        return;
    }
    const std::uint8_t* const bytes = packet.bytes.data();
    const observations::VelodyneModel& model = velodyneOf(options_.model);
    const bool is_data = captures::isVelodyneData(bytes, packet.bytes.size());
    const bool is_of_model =
        is_data && (captures::isOfHdl64(bytes) ? &model == &observations::hdl64Model()
                                               : model.id == bytes[captures::kVelodyneModelAt] &&
                                                     &model != &observations::hdl64Model());
    if (is_of_model && !isOfSensor(packet)) return;
    if (velodyne_->add(bytes, packet.bytes.size(), packet.arrival_s) == Taken::Yes) {
        last_packet_s_ = packet.arrival_s;
        is_flushed_ = false;
        tellChanges();
    }
    if (!recorder_ || !is_of_model) return;
    captures::VelodynePacket raw;
    std::copy(packet.bytes.begin(), packet.bytes.end(), reinterpret_cast<std::uint8_t*>(&raw.raw));
    raw.time_ns = packet.time_ns;
    turns_->add(raw);
    record(*turns_);
}

/// What is complete of the turns of a Velodyne, or of the scans of a Mid-360.
template <class Turns>
void Session::record(Turns& turns) {
    for (const auto& turn : turns.complete()) recorder_->add(turn);
    turns.complete().clear();
}

void Session::takeLivox(const Packet& packet) {
    captures::Datagram datagram;
    datagram.bytes = packet.bytes.data();
    datagram.size = packet.bytes.size();
    const auto data = captures::livoxPacketOf(datagram);
    if (data && !isOfSensor(packet)) return;
    if (livox_->add(packet.bytes.data(), packet.bytes.size(), packet.arrival_s) ==
        streaming::LivoxStream::Taken::Yes) {
        last_packet_s_ = packet.arrival_s;
        is_flushed_ = false;
        tellChanges();
    }
    if (!recorder_ || !data) return;
    scans_->add(*data, packet.time_ns);
    record(*scans_);
}

void Session::takeOuster(const Packet& packet) {
    const std::uint8_t* const bytes = packet.bytes.data();
    const captures::OusterSensor& sensor = ouster_->sensor();
    const bool is_packet =
        packet.bytes.size() == sensor.packetBytes() && captures::isOfLidar(bytes, sensor);
    const bool has_serial = !sensor.profile.is_legacy && !sensor.serial.empty();
    if (is_packet && !has_serial && !isOfSensor(packet)) return;
    const auto taken = ouster_->add(bytes, packet.bytes.size(), packet.arrival_s, packet.time_ns);
    if (taken == streaming::OusterStream::Taken::Yes) {
        last_packet_s_ = packet.arrival_s;
        is_flushed_ = false;
        tellChanges();
    }
    recordOuster();
}

void Session::recordOuster() {
    for (const captures::OusterFrame& frame : ouster_->complete()) {
        if (recorder_) recorder_->add(captures::observationOf(frame, ouster_->sensor()));
    }
    ouster_->complete().clear();
}

/// After a packet was taken.
void Session::tellChanges() {
    if (is_silent_) {
        is_silent_ = false;
        listener_.remark("packets come again");
    }
    if (!velodyne_) return;
    const std::size_t changes = velodyne_->counts().mode_changes;
    if (changes == report_.mode_changes) return;
    report_.mode_changes = changes;
    listener_.remark(velodyne_->isDual() ? "the sensor sends two returns per firing now"
                                         : "the sensor sends one return per firing now");
}

void Session::copyCounts() {
    LiveReport& r = report_;
    if (velodyne_) {
        const auto& counts = velodyne_->counts();
        r.packets = counts.packets;
        r.lost = counts.lost;
        r.late = counts.late;
        r.repeated = counts.repeated;
        r.wrong_size = counts.wrong_size;
        r.foreign = counts.other_model + foreign_ip_;
        r.unsound = counts.unsound;
        r.interruptions = counts.interruptions;
        r.scans = counts.turns;
    } else if (ouster_) {
        const auto& counts = ouster_->counts();
        r.packets = counts.packets;
        r.lost = counts.lost;
        r.late = counts.late;
        r.repeated = counts.repeated;
        r.wrong_size = counts.wrong_size;
        r.position = counts.imu;
        r.foreign = counts.other_sensor + foreign_ip_;
        r.unsound = counts.unsound;
        r.interruptions = counts.interruptions;
        r.scans = counts.turns;
    } else {
        const auto& counts = livox_->counts();
        r.packets = counts.packets;
        r.lost = counts.lost;
        r.late = counts.late;
        r.repeated = counts.repeated;
        r.wrong_size = counts.foreign;
        r.position = counts.imu;
        r.foreign = foreign_ip_;
        r.interruptions = counts.interruptions;
        r.scans = r.sectors / 5;
    }
    r.latest = distances_->at(steadyNow_s());
    r.seconds = steadyNow_s() - start_s_;
}

void Session::showStatus(double now_s) {
    copyCounts();
    LiveStatus status;
    const double passed_s = now_s - status_s_;
    status.turns_per_s = recent_sweep_rad_ / (2 * kPi) / passed_s;
    if (livox_) status.turns_per_s = static_cast<double>(recent_.count()) / passed_s;
    status.p50_s = recent_.quantile_s(0.5);
    status.p99_s = recent_.quantile_s(0.99);
    status.max_s = recent_.count() > 0 ? recent_.max_s() : std::nan("");
    status.is_silent = is_silent_;
    for (const auto& sector : report_.latest) {
        if (sector.state != SectorDistances::State::Obstacle) continue;
        if (!(sector.distance_m >= status.nearest_m)) status.nearest_m = sector.distance_m;
    }
    // Another speed of the motor, twice in a row: packets may have come in a burst.
    const double arrived_s = recent_last_s_ - recent_first_s_;  // not all of the time, at first
    const double rate = arrived_s > kStatus_s / 4 ? recent_sweep_rad_ / (2 * kPi) / arrived_s : 0;
    if (!livox_ && rate > 0 && !is_silent_) {
        const bool is_odd = rate_told_ > 0 && std::abs(rate / rate_told_ - 1) > kOtherRate;
        odd_rates_ = is_odd ? odd_rates_ + 1 : 0;
        if (odd_rates_ == 2) {
            ++report_.rate_changes;
            listener_.remark("the sensor turns " + fixed(rate, 1) + " times per second now, " +
                             fixed(rate_told_, 1) + " before");
        }
        if (rate_told_ == 0 || odd_rates_ == 2) {
            rate_told_ = rate;
            odd_rates_ = 0;
        }
    }
    recent_ = {};
    recent_sweep_rad_ = 0;
    status_s_ = now_s;
    listener_.status(report_, status);
}

void Session::countDirections(double now_s) {
    if (now_s - counted_s_ < kDirections_s) return;
    counted_s_ = now_s;
    for (const auto& direction : distances_->at(now_s)) {
        switch (direction.state) {
            case SectorDistances::State::Unknown:
                ++report_.times_unknown;
                break;
            case SectorDistances::State::SeenNothing:
                ++report_.times_seen_nothing;
                break;
            case SectorDistances::State::Obstacle:
                ++report_.times_obstacle;
                break;
        }
    }
}

void Session::look(bool is_idle) {
    const double now_s = steadyNow_s();
    if (is_idle && report_.datagrams > 0 && !is_flushed_ && now_s - last_packet_s_ > kFlush_s) {
        flush();
        is_flushed_ = true;
    }
    const double silent_s = now_s - (last_packet_s_ > 0 ? last_packet_s_ : start_s_);
    if (!is_silent_ && silent_s > kSilence_s) {
        is_silent_ = true;
        ++report_.silences;
        copyCounts();
        listener_.remark(report_.packets > 0
                             ? "no packets of the sensor for " + fixed(kSilence_s, 0) + " s"
                             : "no packet of " + nameOf(options_) + " has come yet");
    }
    if (recorder_ && !is_recording_told_) {
        const std::string failure = recorder_->failure();
        if (!failure.empty()) {
            is_recording_told_ = true;
            listener_.remark("recording has ended: " + failure);
        }
    }
    countDirections(now_s);
    if (now_s - status_s_ >= kStatus_s) showStatus(now_s);
}

LiveReport Session::finish(double start_cpu_s) {
    flush();
    if (ouster_) ouster_->finish();
    copyCounts();
    report_.filter_cpu_s = threadCpu_s() - start_cpu_s;
    if (!recorder_) return report_;
    if (ouster_) recordOuster();
    if (turns_) {
        turns_->finish();
        record(*turns_);
    }
    if (scans_) {
        scans_->finish();
        record(*scans_);
    }
    report_.recorded = recorder_->finish();
    return report_;
}

base::Json numberOrNull(double value) { return std::isfinite(value) ? base::Json(value) : nullptr; }

void writeStats(const LiveReport& r, const LiveOptions& options, const LiveListener& listener,
                base::OutputPath& file) {
    base::Json json{{"model", options.sensor_json.empty() ? options.model : "Ouster"},
                    {"seconds", r.seconds},
                    {"packets",
                     {{"datagrams", r.datagrams},
                      {"taken", r.packets},
                      {"lost", r.lost},
                      {"late", r.late},
                      {"repeated", r.repeated},
                      {"dropped", r.dropped},
                      {"wrong_size", r.wrong_size},
                      {"position", r.position},
                      {"foreign", r.foreign},
                      {"unsound", r.unsound}}},
                    {"interruptions", r.interruptions},
                    {"silences", r.silences},
                    {"mode_changes", r.mode_changes},
                    {"rate_changes", r.rate_changes},
                    {"directions",
                     {{"unknown", r.times_unknown},
                      {"seen_nothing", r.times_seen_nothing},
                      {"obstacle", r.times_obstacle}}},
                    {"scans", r.scans},
                    {"sectors", r.sectors},
                    {"sectors_cut", r.sectors_cut},
                    {"sectors_doubtful", r.sectors_doubtful},
                    {"returns", r.returns},
                    {"roi", r.roi}};
    json["latency_ms"] =
        base::Json{{"p50", numberOrNull(1e3 * r.latency.quantile_s(0.5))},
                   {"p99", numberOrNull(1e3 * r.latency.quantile_s(0.99))},
                   {"p99.9", numberOrNull(1e3 * r.latency.quantile_s(0.999))},
                   {"max", r.latency.count() > 0 ? base::Json(1e3 * r.latency.max_s()) : nullptr}};
    json["cpu"] = base::Json{{"filter_share", numberOrNull(r.filter_cpu_s / r.seconds)},
                             {"process_share", numberOrNull(r.process_cpu_s / r.seconds)}};
    base::Json nearest = base::Json::array();
    for (const float distance_m : r.nearest_m) {
        nearest.push_back(numberOrNull(static_cast<double>(distance_m)));
    }
    json["nearest_m"] = nearest;
    if (!options.recording.file.empty()) {
        base::Json files = base::Json::array();
        for (const auto& name : r.recorded.files) files.push_back(name.string());
        json["recorded"] = base::Json{{"turns", r.recorded.turns},
                                      {"left_out", r.recorded.left_out},
                                      {"unreadable", r.recorded.unreadable},
                                      {"files", files}};
    }
    for (const auto& [name, counts] : listener.counts) {
        for (const auto& [what, number] : counts()) json[name][what] = number;
    }
    std::ofstream out(file.temporary());
    out << json.dump(2) << '\n';
    out.close();
    if (!out) throw std::runtime_error(file.path().string() + ": cannot be written");
    file.commit();
}

}  // namespace

std::string liveModels() {
    std::string names;
    for (const char* name : {"VLP-16", "Puck Hi-Res", "HDL-32E", "VLP-32C", kHdl64, kLivox}) {
        names += (names.empty() ? " " : ", ") + std::string(name);
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
            observations::velodyneModel(options.model);
        } catch (const std::invalid_argument&) {
            throw std::runtime_error("'" + options.model +
                                     "' cannot be labelled live; supported are" + liveModels() +
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
    std::optional<base::OutputPath> stats;
    if (!options.stats.empty()) stats.emplace(options.stats, base::kFile, options.overwrite);
    Session session(options, listener, source.isLive());
    const double start_s = steadyNow_s(), process_s = processCpu_s(), cpu_s = threadCpu_s();

    PacketQueue queue(kQueue);
    std::atomic<bool> is_at_end = false;
    std::atomic<std::size_t> dropped = 0;
    std::exception_ptr failure;
    std::thread receiver([&] {
        try {
            Packet packet;
            while (!is_at_end) {
                const PacketSource::Next next = source.next(packet);
                if (next == PacketSource::Next::End) break;
                if (next == PacketSource::Next::Nothing) continue;
                if (!source.isLive()) {
                    queue.pushOrWait(packet);
                } else if (!queue.push(packet)) {
                    ++dropped;
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
        if (receiver.joinable()) receiver.join();
    };
    try {
        Packet packet;
        while (listener.keep_going() && steadyNow_s() - start_s < options.duration_s) {
            const auto popped = queue.pop(packet, std::chrono::milliseconds(10));
            if (popped == PacketQueue::Popped::Closed) break;
            if (popped == PacketQueue::Popped::Packet) session.take(packet);
            session.look(popped == PacketQueue::Popped::Nothing);
        }
    } catch (...) {
        stop();
        throw;
    }
    stop();
    // Those that still wait are labelled by nobody.
    session.report().dropped = dropped + (source.isLive() ? queue.size() : 0);
    LiveReport report = session.finish(cpu_s);
    report.process_cpu_s = processCpu_s() - process_s;
    if (stats) writeStats(report, options, listener, *stats);
    if (failure) std::rethrow_exception(failure);
    return report;
}

}  // namespace hagen::live
