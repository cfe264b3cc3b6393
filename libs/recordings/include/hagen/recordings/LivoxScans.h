#pragma once
#include <hagen/scan/Scan.h>
#include <hagen/scan/SensorModel.h>
#include <hagen/sensors/LivoxPacket.h>
#include <mrpt/obs/CObservationPointCloud.h>

#include <cstddef>
#include <cstdint>
#include <deque>
#include <memory>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace hagen::recordings {

/// Puts the packets of one Livox Mid-360 together into scans. The sensor has no turns: a scan is
/// the points of a tenth of a second, by the sensor's clock.
class LivoxScans {
 public:
    struct Counts {
        std::size_t packets = 0;  ///< taken, without those repeated
        std::size_t scans = 0;
        std::size_t lost = 0, late = 0, repeated = 0;
        std::size_t interruptions = 0;  ///< of a second or more, or jumps of the sensor's clock
    };

    /// Scans get this sensor label.
    explicit LivoxScans(std::string label);

    /// `time_ns` is when the packet came; a scan has that of its first packet. A packet that has
    /// come in this scan or the one before is left out; late ones join the scan in progress.
    void add(const sensors::LivoxPacket& packet, std::int64_t time_ns);
    /// Ends the scan in progress.
    void finish();

    /// The scans that are complete, oldest first: LocatedClouds with the points' tags. The caller
    /// takes them out.
    std::deque<mrpt::obs::CObservationPointCloud::Ptr>& complete() { return complete_; }
    const Counts& counts() const { return counts_; }
    const std::string& label() const { return label_; }

 private:
    std::string label_;
    std::shared_ptr<const SensorModel> model_;
    Counts counts_;
    bool is_begun_ = false;
    std::uint16_t last_number_ = 0;
    std::uint64_t start_ns_ = 0, last_ns_ = 0;  ///< of the scan in progress, by the sensor's clock
    std::int64_t first_time_ns_ = 0;            ///< when its first packet came
    Scan scan_;                                 ///< in progress
    std::vector<std::uint8_t> tags_;            ///< of its points
    std::size_t scan_packets_ = 0;
    /// Times and numbers of its packets, and of those of the scan before.
    std::set<std::pair<std::uint64_t, std::uint16_t>> seen_, seen_before_;
    std::deque<mrpt::obs::CObservationPointCloud::Ptr> complete_;
};

}  // namespace hagen::recordings
