#include "support/RotatingScans.h"

#include <hagen/mrpt/MrptCompat.h>
#include <hagen/sensors/VelodyneModel.h>
#include <mrpt/io/CMemoryStream.h>
#include <mrpt/serialization/CArchive.h>
#include <mrpt/version.h>

#include <cmath>

#include "support/RawBytes.h"

namespace hagen::test {

std::string bytesOf(const mrpt::serialization::CSerializable& object) {
    mrpt::io::CMemoryStream stream;
    auto archive = mrpt::serialization::archiveFrom(stream);
    archive << object;
    return {static_cast<const char*>(stream.getRawBufferData()),
            static_cast<std::size_t>(stream.getTotalBytesCount())};
}

mrpt::serialization::CSerializable::Ptr objectOf(const std::string& bytes) {
    observations::registerMrptClasses();
    mrpt::io::CMemoryStream stream(bytes.data(), bytes.size());
    return mrpt::serialization::archiveFrom(stream).ReadObject();
}

/// Bytes from the range image's dimensions to the end, as written by libs/maps of MRPT 2.5.8.
static std::size_t sizeOfImages(const mrpt::obs::CObservationRotatingScan& scan) {
    std::size_t size = 4 + 2 * scan.rangeImage.size() + 4 + scan.intensityImage.size() + 2;
    for (const auto& [name, layer] : scan.rangeOtherLayers) {
        size += 4 + name.size() + 2 * layer.size();
    }
    return size;
}

std::string olderBytesOf(const mrpt::obs::CObservationRotatingScan& scan) {
    std::string bytes = bytesOf(scan);
#if MRPT_VERSION >= 0x020b04
    bytes.erase(bytes.size() - 5, 4);                       // no points
    bytes.erase(bytes.size() - 2 - sizeOfImages(scan), 1);  // stored inside the log
#endif
    return bytes;
}

std::string newerBytesOf(const mrpt::obs::CObservationRotatingScan& scan,
                         const std::vector<float>& points) {
    std::string bytes = olderBytesOf(scan);
    bytes.insert(bytes.size() - 1 - sizeOfImages(scan), 1, '\0');  // stored inside the log
    std::string more =
        points.empty() ? raw(std::uint32_t{0}) : raw(scan.columnCount) + raw(scan.rowCount);
    return bytes.insert(bytes.size() - 1, more + raw(points));
}

RotatingImage rotatingImageOf(const mrpt::obs::CObservationVelodyneScan& packets, const Scan& scan,
                              const RotatingLayout& layout) {
    const auto& model = sensors::velodyneModel("VLP-16");
    RotatingImage image;
    mrpt::obs::CObservationRotatingScan rotating;
    rotating.timestamp = packets.timestamp;
    rotating.sensorLabel = packets.sensorLabel;
    rotating.sensorPose = packets.sensorPose;
    rotating.minRange = packets.minRange;
    rotating.maxRange = packets.maxRange;
    rotating.lidarModel = layout.has_points ? "UNKNOWN_SCANNER" : "VLP-16";
    rotating.rangeResolution = 0.002;
    rotating.rowCount = 16;
    const auto columnOf = [&](std::size_t i) {
        return static_cast<int>(1e6 * static_cast<double>(scan.time_s[i]) / model.firing_period_us +
                                0.01);
    };
    rotating.columnCount = static_cast<std::uint16_t>(24 * packets.scan_packets.size());
    // Azimuths of the blocks in 0.01 degrees, clockwise, two firings each.
    double turn = 0;
    const int start = packets.scan_packets.front().blocks[0].rotation();
    int before = start;
    for (const auto& packet : packets.scan_packets) {
        for (const auto& block : packet.blocks) {
            turn += (block.rotation() - before + 36000) % 36000;
            before = block.rotation();
        }
    }
    const double step_rad = 1e-2 * turn / (rotating.columnCount - 2) * M_PI / 180;
    rotating.startAzimuth = -1e-2 * start * M_PI / 180;
    rotating.azimuthSpan = -step_rad * (rotating.columnCount - 1);
    rotating.sweepDuration = 1e-6 * model.firing_period_us * (rotating.columnCount - 1);
    rotating.rangeImage.setZero(16, rotating.columnCount);
    rotating.intensityImage.setZero(16, rotating.columnCount);
    std::vector<float> points(std::size_t{3} * 16 * rotating.columnCount, 0.0f);
    for (std::size_t i = 0; i < scan.size(); ++i) {
        const int column = columnOf(i);
        const int row = layout.is_highest_first ? 15 - scan.row[i] : scan.row[i];
        rotating.rangeImage(row, column) = static_cast<std::uint16_t>(
            std::lround(static_cast<double>(scan.range_m[i]) / rotating.rangeResolution));
        rotating.intensityImage(row, column) =
            static_cast<std::uint8_t>(std::lround(255.0f * scan.intensity[i]));
        const std::size_t at = 3 * (static_cast<std::size_t>(row) * rotating.columnCount + column);
        points[at] = scan.x_m[i];
        points[at + 1] = scan.y_m[i];
        points[at + 2] = scan.z_m[i];
        image.pixel_of_return.push_back(static_cast<std::uint32_t>(16 * column + row));
    }
    image.bytes = layout.has_points ? newerBytesOf(rotating, points) : bytesOf(rotating);
    return image;
}

}  // namespace hagen::test
