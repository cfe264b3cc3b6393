#pragma once
#include <hagen/filter/Levelling.h>
#include <hagen/filter/Options.h>
#include <hagen/filter/SegmentationResult.h>
#include <hagen/scan/Scan.h>
#include <hagen/scan/SensorModel.h>
#include <memory>
#include <optional>

namespace hagen {

/// The Hagen filter for one sensor: separates near obstacles (RoI) from ground and far returns
/// (ROU). It has no state but the reused memory of its result and workspace. Filters do not depend
/// on each other or on the thread that runs them.
///
///     HagenFilter filter(sensorModel("VLP-16"));
///     Scan scan = ...;                       // coordinates; locateBeams() for the rest
///     const SegmentationResult& result = filter.segment(scan);
///     for (const auto i : result.returns.roi) avoid(scan.x_m[i], scan.y_m[i], scan.z_m[i]);
class HagenFilter {
 public:
    /// Throws std::invalid_argument if options and sensor do not fit together; see checkOptions().
    explicit HagenFilter(SensorModel sensor, Options options = {});

    /// Segments one scan, which may be empty. `attitude` is the sensor's tilt, if known; a sensor
    /// may be mounted at any angle if it is. The images of a sensor that is upside down or on its
    /// side have the rows of its posture (Posture.h). The result is valid until the next call.
    /// Throws std::invalid_argument, saying what to call, if the scan has no ranges, azimuths and
    /// rows yet, or rows of another sensor (checkLocated()); the result is then unchanged.
    const SegmentationResult& segment(const Scan& scan,
                                      const std::optional<Attitude>& attitude = {});

    /// Takes the result out of the filter, which uses the memory of `result` for the next scan
    /// instead. Keeps results beyond the next call without copying them.
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
