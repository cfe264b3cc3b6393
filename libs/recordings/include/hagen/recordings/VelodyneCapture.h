#pragma once
#include <hagen/recordings/LidarCapture.h>
#include <mrpt/obs/CObservationVelodyneScan.h>

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace hagen::recordings {

/// The turns of the Velodyne sensors in a capture: VLP-16, Puck Hi-Res, HDL-32E and VLP-32C, told
/// apart by the id in their packets, and HDL-64E, by their blocks, if there is a calibration.
///
/// The first sensor has the label "velodyne", others "velodyne_2" and so on. The time of a turn is
/// that of the capture at its first packet. The first and the last turn of a capture may be parts.
class VelodyneCapture : public LidarCapture {
 public:
    /// `calibration`: of the HDL-64E (readVelodyneCalibration()); empty: its packets are left out.
    /// Throws BrokenCapture naming the file if it cannot be opened, and std::runtime_error naming
    /// the calibration if that is wrong.
    explicit VelodyneCapture(const std::filesystem::path& file,
                             const std::filesystem::path& calibration = {});
    ~VelodyneCapture() override;

    mrpt::obs::CObservationVelodyneScan::Ptr next();
    mrpt::obs::CObservation::Ptr nextScan() override { return next(); }
    void checkWhileReading(const std::function<void()>& check) override;
    double fractionRead() const override;
    std::vector<std::string> remarks() const override;

 private:
    struct Reader;
    std::unique_ptr<Reader> reader_;
};

}  // namespace hagen::recordings
