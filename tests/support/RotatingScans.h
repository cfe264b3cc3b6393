#pragma once
#include <hagen/scan/Scan.h>
#include <mrpt/obs/CObservationRotatingScan.h>
#include <mrpt/obs/CObservationVelodyneScan.h>

#include <string>

namespace hagen::test {

/// The layout of a VLP-16 scan as a CObservationRotatingScan.
struct RotatingLayout {
    bool has_points = false;        ///< points as in MRPT 3
    bool is_highest_first = false;  ///< row 0 is the highest beam instead of the lowest
};

/// The same returns as a range image with one column per firing and 2 mm resolution, and the pixel
/// of each return, as column * rows + row.
struct RotatingImage {
    std::string bytes;  ///< the object as in a rawlog
    std::vector<std::uint32_t> pixel_of_return;
};
RotatingImage rotatingImageOf(const mrpt::obs::CObservationVelodyneScan& packets, const Scan& scan,
                              const RotatingLayout& layout);

/// An object of a rawlog, and its bytes.
std::string bytesOf(const mrpt::serialization::CSerializable& object);
mrpt::serialization::CSerializable::Ptr objectOf(const std::string& bytes);

/// The bytes of a scan in the layout before MRPT 2.11.4, and in the layout since, in which points
/// are rows * columns * (x, y, z), row by row.
std::string olderBytesOf(const mrpt::obs::CObservationRotatingScan& scan);
std::string newerBytesOf(const mrpt::obs::CObservationRotatingScan& scan,
                         const std::vector<float>& points = {});

}  // namespace hagen::test
