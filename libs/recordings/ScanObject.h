#pragma once
#include <hagen/mrpt/ObservationScan.h>
#include <mrpt/obs/CObservation.h>
#include <mrpt/serialization/CSerializable.h>
#include "recordings/RecordedObject.h"

#include <vector>

namespace hagen::recordings {

/// The observations of a rawlog entry: an observation or those of a sensory frame, without null
/// objects; empty for any other entry.
std::vector<mrpt::obs::CObservation::Ptr> observationsOf(
    const mrpt::serialization::CSerializable::Ptr& entry);

/// Removes the null objects from a sensory frame, which MRPT can read but not write. Returns their
/// number.
std::size_t takeOutNulls(const mrpt::serialization::CSerializable::Ptr& entry);

/// Keeps clouds that were read as CGenericPointsMap in that class, so that all fields are written.
void keepFields(const mrpt::serialization::CSerializable::Ptr& entry);

}  // namespace hagen::recordings
