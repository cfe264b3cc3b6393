#include <hagen/mrpt/LocatedCloud.h>
#include <hagen/recordings/LivoxScans.h>
#include <hagen/recordings/Remarks.h>

#include <utility>

namespace hagen::recordings {
namespace {

constexpr std::uint64_t kScan_ns = 100000000;
constexpr std::uint64_t kInterruption_ns = 1000000000;
constexpr std::size_t kMostPackets = 10000;  // of a scan, whatever the clock says; usual are 210

}  // namespace

LivoxScans::LivoxScans(std::string label)
    : label_(std::move(label)),
      model_(std::make_shared<const SensorModel>(sensorModel("Mid-360"))) {}

void LivoxScans::add(const sensors::LivoxPacket& packet, std::int64_t time_ns) {
    if (is_begun_) {
        const auto step =
            static_cast<std::int16_t>(static_cast<std::uint16_t>(packet.number - last_number_));
        const std::pair<std::uint64_t, std::uint16_t> self{packet.time_ns, packet.number};
        if (seen_.count(self) > 0 || seen_before_.count(self) > 0) {
            ++counts_.repeated;
            return;
        }
        const bool is_earlier = packet.time_ns < last_ns_;
        const std::uint64_t gap_ns =
            is_earlier ? last_ns_ - packet.time_ns : packet.time_ns - last_ns_;
        if (gap_ns > kInterruption_ns) {
            ++counts_.interruptions;
            finish();
            seen_before_.clear();
        } else if (is_earlier) {
            ++counts_.late;  // its points are as good: they join the scan in progress
            if (step < 0 && counts_.lost > 0) --counts_.lost;
        } else {
            // The number starts again with each frame of some firmware.
            if (step > 1) counts_.lost += static_cast<std::size_t>(step - 1);
            if (packet.time_ns - start_ns_ >= kScan_ns) finish();
        }
        if (scan_packets_ == kMostPackets) finish();
    }
    ++counts_.packets;
    if (!is_begun_) {
        is_begun_ = true;
        start_ns_ = packet.time_ns;
        last_ns_ = packet.time_ns;
        first_time_ns_ = time_ns;
    }
    if (packet.time_ns >= last_ns_) {
        last_ns_ = packet.time_ns;
        last_number_ = packet.number;
    }
    seen_.emplace(packet.time_ns, packet.number);
    ++scan_packets_;
    sensors::appendPoints(packet, start_ns_, scan_, tags_);
}

void LivoxScans::finish() {
    if (!is_begun_) return;
    is_begun_ = false;
    scan_packets_ = 0;
    seen_before_ = std::exchange(seen_, {});
    ++counts_.scans;
    locateBeams(*model_, scan_);
    auto observation = mrpt::obs::CObservationPointCloud::Create();
    observation->sensorLabel = label_;
    observation->timestamp = timeOf(first_time_ns_);
    observations::PointTable fields;
    fields.points = scan_.size();
    addColumn("tag", observations::NumberType::UInt8, {tags_.begin(), tags_.end()}, fields);
    observation->pointcloud =
        std::make_shared<observations::LocatedCloud>(scan_, model_, std::move(fields));
    complete_.push_back(observation);
    scan_.clear();
    tags_.clear();
}

}  // namespace hagen::recordings
