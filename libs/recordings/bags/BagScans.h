#pragma once
#include <mrpt/obs/CObservation.h>
#include "recordings/bags/BagPlan.h"

#include <cstddef>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace hagen::recordings {

/// The scans of a bag, and the attitudes of its IMU.
///
/// A cloud becomes a CObservationPointCloud with its header's time. Velodyne packets are grouped
/// into turns and Ouster packets into frames, as in captures; a turn may span two messages. A Livox
/// message is a scan; messages of livox_ros_driver2 are read as from a Mid-360.
class BagScans {
 public:
    /// Throws BrokenRecording naming a file that cannot be opened. `survey` must outlive this
    /// object.
    BagScans(const std::filesystem::path& file, const BagSurvey& survey, const BagOptions& options);
    ~BagScans();

    /// The next scan, or a CObservationIMU with an orientation; null at the end. If the bag is
    /// broken, returns the turns in progress and then throws BrokenRecording. Also throws at the
    /// end if no scan could be read.
    mrpt::obs::CObservation::Ptr next();

    /// Like BagFile::checkWhileReading().
    void checkWhileReading(const std::function<void()>& check);

    const BagPlan& plan() const;
    /// Messages of the bag read so far, of all topics.
    std::size_t messagesRead() const;
    /// Fraction of the bag read so far, 0 ... 1.
    double fractionRead() const;
    /// Remarks on each topic and on skipped messages. Complete at the end.
    std::vector<std::string> remarks() const;

 private:
    struct Reader;
    std::unique_ptr<Reader> reader_;
};

}  // namespace hagen::recordings
