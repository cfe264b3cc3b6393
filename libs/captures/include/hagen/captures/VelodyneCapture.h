#pragma once
#include <hagen/captures/CaptureFile.h>
#include <mrpt/obs/CObservationVelodyneScan.h>

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace hagen::captures {

/// The turns of the Velodyne sensors in a capture: VLP-16, Puck Hi-Res, HDL-32E and VLP-32C, told
/// apart by the id in their packets.
///
/// The first sensor has the label "velodyne", others "velodyne_2" and so on. The time of a turn is
/// that of the capture at its first packet. The first and the last turn of a capture may be parts.
class VelodyneCapture {
 public:
    /// Throws BrokenCapture naming the file if it cannot be opened.
    explicit VelodyneCapture(const std::filesystem::path& file);
    ~VelodyneCapture();

    /// The next turn; null at the end. Where the capture breaks off, the turns in progress come
    /// first. Throws BrokenCapture there, and at the end if there was no packet.
    mrpt::obs::CObservationVelodyneScan::Ptr next();

    double fractionRead() const;

    /// What was found, with figures: the frames, each sensor, and all that was lost or left out.
    /// Complete at the end.
    std::vector<std::string> remarks() const;

 private:
    struct Reader;
    std::unique_ptr<Reader> reader_;
};

}  // namespace hagen::captures
