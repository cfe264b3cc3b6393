#include "sensors/captures/LidarCapture.h"
#include <hagen/sensors/VelodynePacket.h>
#include "sensors/LidarFamily.h"
#include "sensors/captures/Remarks.h"

#include <stdexcept>
#include <utility>

namespace hagen::sensors {
namespace {

/// Counts of frames that did not become datagrams; "" if there are none.
std::string textOfLosses(const FrameCounts& counts) {
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
    CaptureFile capture(file);
    capture.checkWhileReading([&] {
        if (check) check();
        if (capture.counts().frames >= kMaxFrames) throw TooManyFrames();
    });
    Datagram datagram;
    try {
        while (capture.next(datagram) && visit(datagram)) {
        }
    } catch (const BrokenCapture&) {
    } catch (const TooManyFrames&) {
    }
}

/// The family of the first datagrams; null: Velodyne.
const LidarFamily* familyOf(const std::filesystem::path& file, const std::function<void()>& check) {
    constexpr int kDatagrams = 1000;
    const LidarFamily* found = nullptr;
    int datagrams = 0;
    preview(file, check, [&](const Datagram& datagram) {
        for (const LidarFamily& family : lidarFamilies()) {
            if (found == nullptr && family.isData(datagram)) found = &family;
        }
        return found == nullptr && ++datagrams < kDatagrams;
    });
    return found;
}

std::unique_ptr<SweepReader> readerFor(const std::filesystem::path& file,
                                       const std::filesystem::path& sensor_json,
                                       const std::filesystem::path& calibration,
                                       const std::function<void()>& check) {
    const bool is_ouster = !sensor_json.empty();
    const LidarFamily* const family = is_ouster ? nullptr : familyOf(file, check);
    if (!calibration.empty() && (is_ouster || family != nullptr)) {
        throw std::runtime_error(file.string() + ": is read as a capture of " +
                                 (is_ouster ? "an Ouster" : family->called) +
                                 "; the HDL-64E calibration " + calibration.string() +
                                 " does not apply");
    }
    if (is_ouster) return makeOusterSweeps(sensor_json);
    if (family != nullptr) return family->makeSweeps();
    auto velodynes = makeVelodyneSweeps(calibration);
    constexpr double kTwoTurns_ns = 5e8;  // at 5 Hz or faster
    constexpr int kMaxDatagrams = 100000;
    double first_ns = 0;
    int datagrams = 0;
    preview(file, check, [&](const Datagram& datagram) {
        const auto time_ns = static_cast<double>(datagram.time_ns);
        const bool is_data = isVelodyneData(datagram.bytes, datagram.size);
        if (is_data && first_ns == 0) first_ns = time_ns;
        velodynes->preview(datagram);
        return ++datagrams < kMaxDatagrams &&
               (first_ns == 0 || std::abs(time_ns - first_ns) < kTwoTurns_ns);
    });
    return velodynes;
}

}  // namespace

LidarCapture::LidarCapture(const std::filesystem::path& file, std::unique_ptr<SweepReader> reader)
    : file_(file), capture_(file), reader_(std::move(reader)) {}

void LidarCapture::read() {
    Datagram datagram;
    try {
        is_at_end_ = !capture_.next(datagram);
        if (!is_at_end_) reader_->add(datagram);
    } catch (const BrokenCapture& e) {
        broken_because_ = e.what();
        is_at_end_ = true;
    }
    if (is_at_end_) reader_->finish();
}

std::optional<LidarSweep> LidarCapture::nextSweep() {
    auto& complete = reader_->complete();
    while (complete.empty() && !is_at_end_) read();
    if (!complete.empty()) {
        std::optional sweep(std::move(complete.front()));
        complete.pop_front();
        return sweep;
    }
    if (!broken_because_.empty()) throw BrokenCapture(broken_because_);
    const std::string why = reader_->whyEmpty(textOfLosses(capture_.counts()));
    if (!why.empty()) throw BrokenCapture(file_.string() + ": " + why);
    return std::nullopt;
}

std::vector<std::string> LidarCapture::remarks() const {
    const FrameCounts& counts = capture_.counts();
    std::string frames = counted(counts.frames, "frame");
    addCount(counts.tagged, "frame", "with a VLAN tag", frames);
    addCount(counts.fragments, "frame", "with IP fragments", frames);
    const std::string ignored = joined(reader_->ignored(), textOfLosses(counts));
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

}  // namespace hagen::sensors
