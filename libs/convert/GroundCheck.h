#pragma once
#include <hagen/mrpt/ObservationSegmenter.h>
#include <cstddef>
#include <map>
#include <string>

namespace hagen::convert {

/// Counts the scans without ground, in which all returns in the zone are RoI. Labels some of them
/// again with other mounts of the sensor, to distinguish a wrong mount from missing ground.
class GroundCheck {
 public:
    /// Adds a segmented scan. Scans of options without a ground surface do not count.
    void see(const observations::ObservationSegmenter::Output& segmented);

    /// A warning if most scans have no ground: what it means, the likely reason, and the setting
    /// that helps. Otherwise "".
    std::string warning() const;

    std::size_t scans() const { return scans_; }
    std::size_t scansWithGround() const { return with_ground_; }

 private:
    std::size_t scans_ = 0, with_ground_ = 0, tried_ = 0;
    float zone_m_ = 0;
    std::map<std::string, std::size_t> found_;  ///< scans with ground, by settings of a mount
};

}  // namespace hagen::convert
