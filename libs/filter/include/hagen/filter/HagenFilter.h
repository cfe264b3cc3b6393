#pragma once
#include <hagen/filter/Levelling.h>
#include <hagen/filter/Options.h>
#include <hagen/filter/SegmentationResult.h>
#include <hagen/scan/Scan.h>
#include <hagen/scan/SensorModel.h>
#include <memory>
#include <optional>

namespace hagen {

/// The Hagen filter for one sensor: separates near obstacles (RoI) from ground and distant returns
/// (ROU). It keeps no state between scans, only reusable memory. Filters are independent of each
/// other and of the thread that runs them.
///
///     HagenFilter filter(sensorModel("VLP-16"));
///     Scan scan = ...;                       // coordinates; locateBeams() for the rest
///     const SegmentationResult& result = filter.segment(scan);
///     for (const auto i : result.returns.roi) avoid(scan.x_m[i], scan.y_m[i], scan.z_m[i]);
class HagenFilter {
 public:
    /// Throws std::invalid_argument if options and sensor are incompatible; see checkOptions().
    explicit HagenFilter(SensorModel sensor, Options options = {});

    /// Segments one scan, which may be empty. `attitude` is the sensor's tilt, if known; the sensor
    /// may then be mounted at an arbitrary angle. The images of a sensor that is upside down or on
    /// its side have the rows of its posture (Posture.h). The result is valid until the next call.
    /// Throws std::invalid_argument, and leaves the result unchanged, if the scan lacks ranges,
    /// azimuths and rows, or has rows of another sensor (checkLocated()).
    const SegmentationResult& segment(const Scan& scan,
                                      const std::optional<Attitude>& attitude = {});

    /// Segments the concatenated scans of a sliding window (SlidingWindow.h), which begin with the
    /// returns of `newest`. Labels those returns only, unless the options ask for all.
    const SegmentationResult& segment(const Scan& window, const std::optional<Attitude>& attitude,
                                      const Scan& newest);

    /// Swaps the filter's result with `result`, to keep the result beyond the next call without a
    /// copy. The filter reuses the memory of `result`.
    void exchangeResult(SegmentationResult& result);

    const SensorModel& sensor() const;
    const Options& options() const;

    HagenFilter(const HagenFilter& other);
    HagenFilter(HagenFilter&& other) noexcept;
    HagenFilter& operator=(HagenFilter other) noexcept;
    ~HagenFilter();

 private:
    struct State;  ///< the result and all buffers
    std::unique_ptr<State> state_;
};

}  // namespace hagen
