#include <hagen/base/OutputPath.h>
#include <hagen/live/LidarStream.h>
#include <hagen/live/LiveSession.h>
#include "base/NumberText.h"
#include "base/ProcessCost.h"
#include "live/Priority.h"

#include <algorithm>
#include <cmath>
#include <ctime>
#include <exception>

#include "live/Recorder.h"
#include "live/SectorFigures.h"
#include "live/SensorAddress.h"
#include "live/StatsFile.h"

namespace hagen::live {
namespace {

constexpr std::size_t kQueue = 4096;  // packets of several seconds
constexpr double kFlush_s = 0.02;     // pause after which the sector in progress is labelled
constexpr double kStatus_s = 0.5;
// SectorDistances treats a direction as unknown if its turn is 0.3 s old. Packets that waited
// longer than kTooOld_s are therefore dropped, until a packet has waited less than kNew_s.
constexpr double kTooOld_s = 0.15, kNew_s = 0.05;
// An overload ends after this many consecutive statuses without dropped packets.
constexpr int kKeepsUp = 4;

double processCpu_s() {
    return static_cast<double>(std::clock()) / static_cast<double>(CLOCKS_PER_SEC);
}

double threadCpu_s() { return std::chrono::duration<double>(base::threadCpuTime()).count(); }

/// Labels, reports and records the packets of a sensor.
class Session {
 public:
    Session(const LiveOptions& options, const LiveListener& listener, bool is_live)
        : options_(options),
          listener_(listener),
          start_s_(steadyNow_s()),
          status_s_(start_s_),
          address_(options.from_ip) {
        stream_.emplace(
            sensors::makeDriver(options.model, options.sensor_json, options.calibration),
            options.settings, [this](const LabelledSector& sector) { takeSector(sector); },
            options.streaming);
        const StreamingSegmenter& segmenter = stream_->segmenter();
        figures_.emplace(segmenter.sensor(), options_.settings, report_);
        listener_.begin(segmenter.sensor(), segmenter.options());
        if (options.recording.file.empty()) return;
        recorder_ = std::make_unique<Recorder>(options.recording, bool{listener_.motion}, !is_live);
    }

    void take(const Packet& packet) {
        ++report_.datagrams;
        last_taken_s_ = packet.arrival_s;
        if (listener_.motion) {
            const SensorMotion motion = listener_.motion(packet.arrival_s);
            stream_->move(motion);
            if (recorder_) recordPose(packet, motion);
        }
        if (!isOfSensor(packet)) return;
        if (stream_->add(packet.datagram(), packet.arrival_s) == sensors::Taken::Yes) {
            last_packet_s_ = packet.arrival_s;
            is_flushed_ = false;
            if (stream_->counts().packets == 1) {
                listener_.remark("receiving packets from " + sensors::ipText(packet.from_ip));
            }
            reportChanges();
        } else {
            reportUncertain();
        }
    }
    /// Drops a packet that waited too long.
    void drop(const Packet& packet) {
        last_taken_s_ = packet.arrival_s;
        if (!stream_->driver().isData(packet.datagram()) || !isOfSensor(packet)) return;
        if (last_return_s_ > 0) last_return_s_ += packet.arrival_s - last_packet_s_;
        last_packet_s_ = packet.arrival_s;
        ++dropped_;
        reportReturn();
        if (report_.datagrams == 0) return;  // the packet arrived before the session
        if (keeps_up_ >= kKeepsUp) {
            listener_.remark("labelling is too slow: dropping packets that waited too long");
        }
        keeps_up_ = 0;
    }
    /// Counts packets that were not labelled. Thread-safe.
    void lose(std::size_t packets) { lost_ += packets; }
    /// Records a datagram; called by the receiving thread.
    void record(const Packet& packet) {
        if (recorder_) recorder_->add(packet);
    }
    /// Unblocks a thread that waits in record().
    void endRecording() {
        if (recorder_) recorder_->close();
    }
    /// Reports silence and status, and labels the sector in progress if the sensor is silent.
    /// `is_idle` means that the queue is empty.
    void update(bool is_idle) {
        const double now_s = steadyNow_s();
        // Packets waiting for a busy processor do not count as silence, and packets from other
        // senders do not end the silence.
        const double heard_s = is_idle ? now_s : last_taken_s_;
        if (report_.datagrams > 0 && !is_flushed_ && heard_s - last_packet_s_ > kFlush_s) {
            stream_->flush();
            is_flushed_ = true;
        }
        reportSilence(heard_s);
        if (recorder_) reportRecording();
        figures_->countDirections(now_s);
        if (now_s - status_s_ >= kStatus_s) showStatus(now_s);
    }
    LiveReport finish(double start_cpu_s) {
        stream_->flush();
        stream_->driver().finish();
        copyCounts();
        report_.filter_cpu_s = threadCpu_s() - start_cpu_s;
        if (recorder_) report_.recorded = recorder_->finish();
        return report_;
    }

 private:
    /// Whether a packet is from the sensor. Addresses distinguish sensors of the same model without
    /// serial numbers.
    bool isOfSensor(const Packet& packet) {
        const sensors::LidarDriver& driver = stream_->driver();
        if ((driver.hasSerial() && !options_.from_ip) || !driver.isData(packet.datagram()))
            return true;
        const sensors::IpAddress before = address_.ip().value_or(packet.from_ip);
        const std::size_t others = address_.others().size();
        const bool is_of_sensor = address_.take(packet.from_ip, packet.arrival_s);
        if (address_.others().size() > others) {
            listener_.remark("ignoring packets of another sensor from " +
                             sensors::ipText(address_.others().back()) +
                             (options_.from_ip ? "" : "; select a sensor with --from-address"));
        }
        if (!is_of_sensor) {
            ++foreign_ip_;
            return false;
        }
        if (before != packet.from_ip) {
            listener_.remark("the sensor's address changed from " + sensors::ipText(before) +
                             " to " + sensors::ipText(packet.from_ip));
            stream_->flush();  // so that no sector mixes returns from both addresses
        }
        return true;
    }
    /// Removes the mount from the sensor's pose. Before the first position is known, poses are
    /// recorded at the origin, because labelling needs the tilt. Later poses without position are
    /// skipped.
    void recordPose(const Packet& packet, const SensorMotion& motion) {
        Eigen::Isometry3d map_from_sensor = Eigen::Isometry3d::Identity();
        if (motion.map_from_sensor) {
            has_place_ = true;
            map_from_sensor = *motion.map_from_sensor;
        } else if (motion.attitude && !has_place_) {
            map_from_sensor.linear() = levelFromSensor(*motion.attitude).cast<double>();
        } else {
            return;
        }
        map_from_sensor.linear() *=
            levelFromSensor(options_.settings.mount).cast<double>().transpose();
        recorder_->addPose(packet.time_ns, map_from_sensor);
    }
    void takeSector(const LabelledSector& sector) {
        figures_->take(sector, steadyNow_s());
        listener_.sector(sector);
        reportEmptiness(sector.returns);
        figures_->checkTurn(sector);
        if (!is_result_reported_) {
            const std::vector<std::string> warnings = figures_->resultWarnings();
            is_result_reported_ = !warnings.empty();
            for (const std::string& warning : warnings) listener_.remark("WARNING: " + warning);
        }
        if (is_airframe_reported_) return;
        const std::string warning = figures_->airframeWarning(sector.last_time_s);
        is_airframe_reported_ = !warning.empty();
        if (is_airframe_reported_) listener_.remark(warning);
    }
    void reportRecording() {
        if (is_recording_reported_) return;
        const std::string failure = recorder_->failure();
        if (!failure.empty()) {
            is_recording_reported_ = true;
            listener_.remark("recording stopped: " + failure);
        } else if (recorder_->leftOut() > 0 && !is_slow_recording_reported_) {
            is_slow_recording_reported_ = true;
            listener_.remark("the disk is too slow: datagrams are missing from the recording");
        }
    }
    /// Reports that returns are missing, because a covered window looks like open air.
    void reportEmptiness(const Scan& returns) {
        const bool is_empty = std::all_of(returns.range_m.begin(), returns.range_m.end(),
                                          [](float range_m) { return std::isnan(range_m); });
        if (!is_empty || last_return_s_ == 0) last_return_s_ = last_packet_s_;
        if (is_empty_ && !is_empty) listener_.remark("receiving returns");
        if (!is_empty) is_empty_ = false;
        if (is_empty_ || last_packet_s_ - last_return_s_ <= kSilence_s) return;
        is_empty_ = true;
        listener_.remark(
            "no returns for " + base::fixedText(kSilence_s, 0) +
            " s, though packets arrive: nothing is in range, or the sensor's window is "
            "covered");
    }
    void reportChanges() {
        if (is_uncertain_) {
            is_uncertain_ = false;
            listener_.remark("the sensor's turns match its metadata again");
        }
        reportReturn();
        const std::size_t changes = stream_->counts().mode_changes;
        if (changes == mode_changes_) return;
        mode_changes_ = changes;
        listener_.remark(stream_->driver().isDual() ? "the sensor now sends two returns per firing"
                                                    : "the sensor now sends one return per firing");
    }
    void reportUncertain() {
        const sensors::PacketCounts& counts = stream_->counts();
        if (counts.uncertain == uncertain_) return;
        uncertain_ = counts.uncertain;
        const bool is_restarted = counts.restarts > restarts_;
        restarts_ = counts.restarts;
        if (is_uncertain_ && !is_restarted) return;
        is_uncertain_ = true;
        const std::string columns = "the columns in " + options_.sensor_json.string();
        listener_.remark(is_restarted
                             ? "the sensor restarted; dropping its packets until its turns match " +
                                   columns
                             : "the sensor's turns do not match " + columns +
                                   "; dropping its packets. Is the sensor in another mode?");
    }
    void reportSilence(double now_s) {
        const double silent_s = now_s - (last_packet_s_ > 0 ? last_packet_s_ : start_s_);
        if (is_silent_ || silent_s <= kSilence_s) return;
        is_silent_ = true;
        ++report_.silences;
        copyCounts();
        listener_.remark(report_.packets > 0
                             ? "no valid packet from the sensor for " +
                                   base::fixedText(kSilence_s, 0) + " s"
                             : "no packet from " + sensorName(options_) + " received yet");
    }
    void reportReturn() {
        if (!is_silent_) return;
        is_silent_ = false;
        last_return_s_ = last_packet_s_;
        listener_.remark("receiving packets");
    }
    /// Whether packets were dropped since the last status. If so, turns are incomplete and yield no
    /// valid rate.
    bool updateOverload() {
        const bool is_behind = dropped_ > dropped_before_;
        dropped_before_ = dropped_;
        if (!is_behind && keeps_up_ < kKeepsUp && ++keeps_up_ == kKeepsUp) {
            listener_.remark("labelling keeps up again");
        }
        return is_behind;
    }
    void copyCounts() {
        static_cast<sensors::PacketCounts&>(report_) = stream_->counts();
        report_.other_sensor += foreign_ip_;
        report_.dropped = dropped_ + lost_;
        figures_->update(steadyNow_s());
        report_.seconds = steadyNow_s() - start_s_;
    }
    void showStatus(double now_s) {
        copyCounts();
        const bool turns = stream_->driver().turns();
        LiveStatus status = figures_->status(now_s - status_s_, turns);
        status.is_silent = is_silent_;
        const bool is_behind = updateOverload();
        if (turns && !is_silent_ && !is_behind) {
            if (const auto change = figures_->rateChange()) {
                listener_.remark("the turn rate changed from " +
                                 base::fixedText(change->before, 1) + " to " +
                                 base::fixedText(change->now, 1) + " Hz");
            }
        }
        figures_->next();
        status_s_ = now_s;
        listener_.status(report_, status);
    }

    const LiveOptions& options_;
    const LiveListener& listener_;
    LiveReport report_;
    std::optional<LidarStream> stream_;
    std::optional<SectorFigures> figures_;
    std::unique_ptr<Recorder> recorder_;

    double start_s_, status_s_;
    double last_packet_s_ = 0, last_taken_s_ = 0;  ///< from the sensor; from all senders
    double last_return_s_ = 0;
    SensorAddress address_;
    std::size_t uncertain_ = 0, restarts_ = 0, mode_changes_ = 0;  ///< counts already reported
    bool is_uncertain_ = false;
    bool is_flushed_ = true, is_silent_ = false, is_empty_ = false;
    bool is_recording_reported_ = false, is_slow_recording_reported_ = false;
    bool is_airframe_reported_ = false, is_result_reported_ = false;
    bool has_place_ = false;
    std::size_t foreign_ip_ = 0;
    std::size_t dropped_ = 0, dropped_before_ = 0;  ///< total, and total at the last status
    int keeps_up_ = kKeepsUp;                       ///< statuses without dropped packets
    std::atomic<std::size_t> lost_ = 0;
};

}  // namespace

std::string sensorName(const LiveOptions& options) {
    return (options.sensor_json.empty() ? "a " + options.model
                                        : "the Ouster of " + options.sensor_json.string()) +
           (options.from_ip ? " at " + sensors::ipText(*options.from_ip) : "");
}

LiveReport runLive(PacketSource& source, const LiveOptions& options, const LiveListener& listener) {
    sensors::checkDriver(options.model, options.sensor_json, options.calibration);
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
    lowerPriority();
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
                    session.drop(packet);
                } else {
                    session.take(packet);
                }
            }
            session.update(popped == PacketQueue::Popped::Nothing);
        }
    } catch (...) {
        stop();
        throw;
    }
    stop();
    session.lose(source.isLive() ? queue.size() : 0);
    LiveReport report = session.finish(cpu_s);
    report.process_cpu_s = processCpu_s() - process_s;
    if (stats) {
        try {
            writeStats(report, options, listener, *stats);
        } catch (const std::exception& e) {  // other outputs must not fail
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
