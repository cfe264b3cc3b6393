#pragma once
#include <hagen/mrpt/ObservationScan.h>
#include <mrpt/obs/CObservation.h>
#include <mrpt/serialization/CSerializable.h>
#include "recordings/RecordedObject.h"

#include <vector>

namespace hagen::recordings {

/// The observations of a rawlog's entry, which is an observation or a sensory frame; none for any
/// other entry. Null objects of a frame are skipped.
std::vector<mrpt::obs::CObservation::Ptr> observationsOf(
    const mrpt::serialization::CSerializable::Ptr& entry);

/// Takes the null objects out of a sensory frame: MRPT reads such frames, but cannot write them.
/// Returns their number.
std::size_t takeOutNulls(const mrpt::serialization::CSerializable::Ptr& entry);

/// Has the clouds of an entry that were read as CGenericPointsMap written as such, with all fields.
void keepFields(const mrpt::serialization::CSerializable::Ptr& entry);

}  // namespace hagen::recordings
