#pragma once
#include <hagen/mrpt/PointTable.h>
#include <mrpt/maps/CPointsMap.h>

#include <array>
#include <optional>
#include <string>
#include <vector>

namespace hagen::observations {

/// Lets older MRPTs read the CGenericPointsMap and CSimplePointsMap of MRPT 2.15 to 3 as
/// CPointsMapXYZI and CSimplePointsMap, and writes them as such unless writeAsGeneric() is called.
/// MRPT 2.15 and later then read a CGenericPointsMap of all versions, as a class derived from it,
/// so that MRPT does not read one into an existing object. Call once, after registering MRPT's own
/// classes (registerMrptClasses()).
void registerNewerClouds();

/// The fields of a CGenericPointsMap, except coordinates and intensity. Results in clouds of other
/// classes do not contain them.
std::vector<std::string> fieldsNotKept(const mrpt::maps::CPointsMap& cloud);
/// All fields of a CGenericPointsMap except coordinates, one row per point of the cloud, without
/// fields whose size differs. No value for clouds of other classes.
std::optional<PointTable> otherFieldsOf(const mrpt::maps::CPointsMap& cloud);

/// Fields (uint8) that RawLogViewer shows as the colours of points, from MRPT 2.15 on.
constexpr std::array<const char*, 3> kColorFields{"color_r", "color_g", "color_b"};

/// A cloud that is serialized as a CGenericPointsMap, with all fields of a checked little-endian
/// table: as version 3, which requires MRPT 2.15 or later, or with MRPT 3 as version 4, which
/// requires MRPT 3. uint8, uint16, float32, float64 and with MRPT 3 uint32 keep their types; other
/// numbers become float64, intensities float32. Several numbers per point become NAME_0, NAME_1.
/// Throws std::invalid_argument if x, y or z is missing. Sets renderOptions to the colour of the
/// first point.
mrpt::maps::CPointsMap::Ptr genericCloudOf(const PointTable& table);

/// Lets a cloud that was read as a CGenericPointsMap be written as the same class with MRPT before
/// 2.15; later versions always do so. Ignores other clouds.
void writeAsGeneric(mrpt::maps::CPointsMap& cloud);

}  // namespace hagen::observations
