#pragma once
#include <hagen/mrpt/ObservationScan.h>
#include <mrpt/obs/CObservation.h>
#include <mrpt/serialization/CSerializable.h>

#include <optional>
#include <vector>

namespace hagen::recordings {

/// The observations of a rawlog entry: the entry itself, or the observations of a sensory frame
/// without null objects; empty for other entries.
std::vector<mrpt::obs::CObservation::Ptr> observationsOf(
    const mrpt::serialization::CSerializable::Ptr& entry);

/// Removes null objects, which MRPT can read but not write, from a sensory frame. Returns their
/// number.
std::size_t takeOutNulls(const mrpt::serialization::CSerializable::Ptr& entry);

/// Keeps the class of clouds read as CGenericPointsMap, so that all fields are written.
void keepFields(const mrpt::serialization::CSerializable::Ptr& entry);

/// Converts a scan of a capture, a bag or a live sensor to an object of an output rawlog. Packets
/// stay unchanged; clouds get the requested class, or become null if no class is requested.
mrpt::serialization::CSerializable::Ptr objectOf(
    const mrpt::obs::CObservation::Ptr& scan,
    const std::optional<observations::CloudClass>& cloud_class);

}  // namespace hagen::recordings
