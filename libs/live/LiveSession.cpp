#include <hagen/base/OutputPath.h>
#include <hagen/base/ProcessCost.h>
#include <hagen/live/LiveSession.h>
#include <hagen/live/PacketQueue.h>

#include <atomic>
#include <chrono>
#include <ctime>
#include <exception>
#include <optional>
#include <thread>

#include "LiveReporter.h"
#include "LiveSensor.h"
#include "LiveStats.h"

namespace hagen::live {
namespace {

constexpr std::size_t kQueue = 4096;  // packets: seconds
constexpr double kFlush_s = 0.02;     // without packets; the sector in progress gets its labels

double processCpu_s() {
    return static_cast<double>(std::clock()) / static_cast<double>(CLOCKS_PER_SEC);
}

double threadCpu_s() { return std::chrono::duration<double>(base::threadCpuTime()).count(); }

/// A sensor, and what is told of it.
class Session {
 public:
    Session(const LiveOptions& options, const LiveListener& listener, bool is_live)
        : listener_(listener),
          sensor_(options, listener,
                  [this](const streaming::LabelledSector& sector) { reporter_.sector(sector); }),
          reporter_(options, listener, sensor_) {
        listener.begin(sensor_.segmenter().sensor(), sensor_.segmenter().options());
        sensor_.startRecording(is_live);
    }

    void take(const Packet& packet) {
        reporter_.datagram();
        if (listener_.motion) sensor_.move(listener_.motion(packet.arrival_s));
        if (sensor_.take(packet)) reporter_.packet();
    }

    /// If no packet waits, ends the sector in progress.
    void look(bool is_idle) {
        const double now_s = steadyNow_s();
        if (is_idle && !sensor_.isFlushed() && now_s - sensor_.lastPacket_s() > kFlush_s) {
            sensor_.flush();
        }
        reporter_.look(now_s);
    }

    LiveReport finish(double start_cpu_s, std::size_t dropped) {
        sensor_.end();
        LiveReport& report = reporter_.report();
        report.dropped = dropped;
        report.filter_cpu_s = threadCpu_s() - start_cpu_s;
        report.recorded = sensor_.finishRecording();
        return report;
    }

 private:
    const LiveListener& listener_;
    LiveSensor sensor_;
    LiveReporter reporter_;
};

}  // namespace

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
    LiveReport report = session.finish(cpu_s, dropped);
    report.process_cpu_s = processCpu_s() - process_s;
    if (stats) writeStats(report, options, listener, *stats);
    if (failure) std::rethrow_exception(failure);
    return report;
}

}  // namespace hagen::live
