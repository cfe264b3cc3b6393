#pragma once
#include <hagen/mrpt/PointTable.h>
#include <mrpt/maps/CPointsMap.h>

#include <array>
#include <string>
#include <vector>

namespace hagen::observations {

/// Lets older MRPTs read the CGenericPointsMap and CSimplePointsMap of MRPT 2.15 to 3 as
/// CPointsMapXYZI and CSimplePointsMap, and writes them as such unless writeAsGeneric() is called.
/// With newer MRPTs, clouds read as CGenericPointsMap are written as such, with the types of
/// genericCloudOf(). Call once, after registering MRPT's own classes (registerMrptClasses()).
void registerNewerClouds();

/// The fields of a cloud read as CGenericPointsMap, except coordinates and intensity. Results in
/// clouds of other classes do not contain them.
std::vector<std::string> fieldsNotKept(const mrpt::maps::CPointsMap& cloud);
/// Like fieldsNotKept(), as a table with one row per point of the cloud, without fields whose size
/// differs. Null if the cloud was read as another class.
const PointTable* otherFieldsOf(const mrpt::maps::CPointsMap& cloud);

/// Fields (uint8) that RawLogViewer shows as the colours of points, from MRPT 2.15 on.
constexpr std::array<const char*, 3> kColorFields{"color_r", "color_g", "color_b"};

/// A cloud that is serialized as a CGenericPointsMap (version 3, requires MRPT 2.15 or later), with
/// all fields of a checked little-endian table. uint8, uint16, float32 and float64 keep their
/// types; other numbers become float64. Several numbers per point become NAME_0, NAME_1. Throws
/// std::invalid_argument if x, y or z is missing. Sets renderOptions to the colour of the first
/// point.
mrpt::maps::CPointsMap::Ptr genericCloudOf(const PointTable& table);

/// Lets a cloud that was read as a CGenericPointsMap be written as the same class. Ignores other
/// clouds.
void writeAsGeneric(mrpt::maps::CPointsMap& cloud);

}  // namespace hagen::observations
