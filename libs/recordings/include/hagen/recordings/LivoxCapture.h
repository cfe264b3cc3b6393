#pragma once
#include <hagen/recordings/LidarCapture.h>
#include <mrpt/obs/CObservationPointCloud.h>

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace hagen::recordings {

/// The points of the Livox Mid-360 sensors in a capture (packets of Livox SDK 2, Cartesian data).
///
/// The sensor has no turns: a scan is the points of a tenth of a second, by the sensor's clock. It
/// is a LocatedCloud with the label "livox", further ones "livox_2" and so on.
class LivoxCapture : public LidarCapture {
 public:
    /// Throws BrokenCapture naming the file if it cannot be opened.
    explicit LivoxCapture(const std::filesystem::path& file);
    ~LivoxCapture() override;

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
