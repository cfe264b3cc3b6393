#pragma once
#include <hagen/filter/HagenFilter.h>
#include <hagen/scan/Label.h>
#include <hagen/scan/Scan.h>
#include <hagen/scan/SensorModel.h>
#include <array>
#include <cstddef>
#include <string>
#include <vector>

namespace hagen {

/// Looks for suspicious results: scans without ground or without obstacles, and returns whose
/// ranges, neighbours or times cannot be those of a LiDAR. Scans of fewer than 100 returns do not
/// count. Not thread-safe.
class ResultCheck {
 public:
    /// `tries_mounts`: labels some scans without ground again, which takes time.
    explicit ResultCheck(bool tries_mounts = true) : tries_mounts_(tries_mounts) {}

    /// Adds a labelled scan: `label` has one label per return.
    void add(const Scan& scan, const std::vector<Label>& label, const SensorModel& sensor,
             const Options& options);

    /// A warning for each property that most scans have: what it means, the likely cause, and what
    /// helps. Empty if the results are plausible.
    std::vector<std::string> warnings() const;

    /// Number of scans of a filter with a ground surface, and of those in which no ground was
    /// found.
    std::size_t scans() const { return ground_.scans; }
    std::size_t scansWithoutGround() const { return ground_.suspicious; }

 private:
    struct Count {
        std::size_t scans = 0, suspicious = 0;

        void add(bool is_suspicious);
        bool isMost() const { return 2 * suspicious > scans; }
        /// Such as "3 of 5 scans".
        std::string text() const;
    };

    void tryMounts(const Scan& scan, const SensorModel& sensor, const Options& options);
    std::string groundWarning() const;

    Count ground_, obstacles_, one_range_, too_far_, too_near_, neighbours_, times_;
    bool tries_mounts_;
    std::size_t seen_ = 0, tried_ = 0;
    float zone_m_ = 0, range_m_ = 0, time_s_ = 0;  ///< of the latest scan: range and time span
    std::array<std::size_t, 5> found_{};           ///< scans with ground, by mount tried
};

}  // namespace hagen
