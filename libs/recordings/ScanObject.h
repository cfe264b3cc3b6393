#pragma once
#include <hagen/mrpt/ObservationScan.h>
#include <mrpt/obs/CObservation.h>
#include <mrpt/serialization/CSerializable.h>
#include "recordings/RecordedObject.h"

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

}  // namespace hagen::recordings
