#pragma once
#include <hagen/recordings/LidarCapture.h>
#include <mrpt/obs/CObservationPointCloud.h>

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace hagen::recordings {

/// The frames of one Ouster in a capture, with the sensor's metadata. Profiles: those that
/// readOusterSensor() knows.
///
/// A scan is a LocatedCloud with the label "ouster". Its origin is that of the beams, and the pose
/// of the sensor on the vehicle is from there to the sensor's base. Its time is that of the capture
/// at the frame's first packet. The first and the last frame of a capture may be parts.
class OusterCapture : public LidarCapture {
 public:
    /// Throws std::runtime_error naming the file that cannot be read.
    OusterCapture(const std::filesystem::path& file, const std::filesystem::path& sensor_json);
    ~OusterCapture() override;

    mrpt::obs::CObservationPointCloud::Ptr next();
    mrpt::obs::CObservation::Ptr nextScan() override { return next(); }
    void checkWhileReading(const std::function<void()>& check) override;
    double fractionRead() const override;
    std::vector<std::string> remarks() const override;

 private:
    struct Reader;
    std::unique_ptr<Reader> reader_;
};

}  // namespace hagen::recordings
