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

/// Reads the scans of a bag, and the attitudes of its IMU.
///
/// A cloud becomes a CObservationPointCloud with the time in its header. Velodyne and Hesai packets
/// are grouped into turns and Ouster packets into frames, as in captures; a turn may span two
/// messages. A Livox message is a scan; messages of livox_ros_driver2 are decoded as those of a
/// Mid-360.
class BagScans {
 public:
    /// Throws BrokenRecording naming the file if it cannot be opened. `survey` must outlive this
    /// object.
    BagScans(const std::filesystem::path& file, const BagSurvey& survey, const BagOptions& options);
    ~BagScans();

    /// Returns the next scan or a CObservationIMU with an orientation; null at the end. If the bag
    /// is broken, returns the turns in progress and then throws BrokenRecording. Throws at the end
    /// if no scan could be read.
    mrpt::obs::CObservation::Ptr next();

    /// Like BagFile::checkWhileReading().
    void checkWhileReading(const std::function<void()>& check);

    const BagPlan& plan() const;
    /// Number of messages read so far, of all topics.
    std::size_t messagesRead() const;
    double fractionRead() const;
    /// Remarks on topics and skipped messages. Complete at the end.
    std::vector<std::string> remarks() const;

 private:
    struct Reader;
    std::unique_ptr<Reader> reader_;
};

}  // namespace hagen::recordings
