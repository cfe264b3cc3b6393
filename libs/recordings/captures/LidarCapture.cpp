#include "recordings/captures/LidarCapture.h"
#include <hagen/sensors/VelodynePacket.h>
#include "recordings/Remarks.h"
#include "sensors/LidarFamily.h"

#include <stdexcept>
#include <utility>

namespace hagen::recordings {
namespace {

/// Counts of frames that did not become datagrams; "" if there are none.
std::string textOfLosses(const sensors::FrameCounts& counts) {
    std::string text;
    addCount(counts.other_traffic, "frame", "of other traffic", text);
    addCount(counts.cut_frames, "frame", "truncated by the capture", text);
    addCount(counts.fragments_lost, "IP fragment", "of incomplete datagrams", text);
    return text;
}

/// Calls visit() with the datagrams at the start of a capture until it returns false. Read errors
/// are reported later.
template <class Visit>
void preview(const std::filesystem::path& file, const std::function<void()>& check, Visit visit) {
    constexpr std::size_t kMaxFrames = 1000000;  // a file may have no datagrams
    struct TooManyFrames {};
    sensors::CaptureFile capture(file);
    capture.checkWhileReading([&] {
        if (check) check();
        if (capture.counts().frames >= kMaxFrames) throw TooManyFrames();
    });
    sensors::Datagram datagram;
    try {
        while (capture.next(datagram) && visit(datagram)) {
        }
    } catch (const sensors::BrokenCapture&) {
    } catch (const TooManyFrames&) {
    }
}

/// The family of the first datagrams; null: Velodyne.
const sensors::LidarFamily* familyOf(const std::filesystem::path& file,
                                     const std::function<void()>& check) {
    constexpr int kDatagrams = 1000;
    const sensors::LidarFamily* found = nullptr;
    int datagrams = 0;
    preview(file, check, [&](const sensors::Datagram& datagram) {
        for (const sensors::LidarFamily& family : sensors::lidarFamilies()) {
            if (found == nullptr && family.isData(datagram)) found = &family;
        }
        return found == nullptr && ++datagrams < kDatagrams;
    });
    return found;
}

std::unique_ptr<sensors::SweepReader> readerFor(const std::filesystem::path& file,
                                                const std::filesystem::path& sensor_json,
                                                const std::filesystem::path& calibration,
                                                const std::function<void()>& check) {
    const bool is_ouster = !sensor_json.empty();
    const sensors::LidarFamily* const family = is_ouster ? nullptr : familyOf(file, check);
    if (!calibration.empty() && (is_ouster || family != nullptr)) {
        throw std::runtime_error(file.string() + ": is read as a capture of " +
                                 (is_ouster ? "an Ouster" : family->called) +
                                 "; the HDL-64E calibration " + calibration.string() +
                                 " does not apply");
    }
    if (is_ouster) return sensors::makeOusterSweeps(sensor_json);
    if (family != nullptr) return family->makeSweeps();
    auto velodynes = sensors::makeVelodyneSweeps(calibration);
    constexpr double kTwoTurns_ns = 5e8;  // at 5 Hz or faster
    constexpr int kMaxDatagrams = 100000;
    double first_ns = 0;
    int datagrams = 0;
    preview(file, check, [&](const sensors::Datagram& datagram) {
        const auto time_ns = static_cast<double>(datagram.time_ns);
        const bool is_data = sensors::isVelodyneData(datagram.bytes, datagram.size);
        if (is_data && first_ns == 0) first_ns = time_ns;
        velodynes->preview(datagram);
        return ++datagrams < kMaxDatagrams &&
               (first_ns == 0 || std::abs(time_ns - first_ns) < kTwoTurns_ns);
    });
    return velodynes;
}

}  // namespace

LidarCapture::LidarCapture(const std::filesystem::path& file,
                           std::unique_ptr<sensors::SweepReader> reader)
    : file_(file), capture_(file), reader_(std::move(reader)) {}

void LidarCapture::read() {
    sensors::Datagram datagram;
    try {
        is_at_end_ = !capture_.next(datagram);
        if (!is_at_end_) reader_->add(datagram);
    } catch (const sensors::BrokenCapture& e) {
        broken_because_ = e.what();
        is_at_end_ = true;
    }
    if (is_at_end_) reader_->finish();
}

mrpt::obs::CObservation::Ptr LidarCapture::nextScan() {
    auto& complete = reader_->complete();
    while (complete.empty() && !is_at_end_) read();
    if (!complete.empty()) {
        auto observation = observationOf(complete.front());
        complete.pop_front();
        return observation;
    }
    if (!broken_because_.empty()) throw sensors::BrokenCapture(broken_because_);
    const std::string why = reader_->whyEmpty(textOfLosses(capture_.counts()));
    if (!why.empty()) throw sensors::BrokenCapture(file_.string() + ": " + why);
    return nullptr;
}

std::vector<std::string> LidarCapture::remarks() const {
    const sensors::FrameCounts& counts = capture_.counts();
    std::string frames = counted(counts.frames, "frame");
    addCount(counts.tagged, "frame", "with a VLAN tag", frames);
    addCount(counts.fragments, "frame", "with IP fragments", frames);
    const std::string ignored = sensors::joined(reader_->ignored(), textOfLosses(counts));
    std::vector<std::string> remarks = reader_->remarks();
    remarks.push_back(frames + "; ignored: " + (ignored.empty() ? "none" : ignored));
    return remarks;
}

std::unique_ptr<LidarCapture> openCapture(const std::filesystem::path& file,
                                          const std::filesystem::path& sensor_json,
                                          const std::filesystem::path& calibration,
                                          const std::function<void()>& check) {
    auto reader = readerFor(file, sensor_json, calibration, check);
    auto capture = std::make_unique<LidarCapture>(file, std::move(reader));
    if (check) capture->checkWhileReading(check);
    return capture;
}

}  // namespace hagen::recordings
