#pragma once
#include <hagen/observations/ObservationScan.h>
#include <mrpt/obs/CObservation.h>
#include <mrpt/serialization/CSerializable.h>

#include <optional>

namespace hagen::logs {

/// What an output rawlog holds of a scan of a capture or a bag: packets as they are, a cloud of the
/// class asked for; null if none is asked for.
mrpt::serialization::CSerializable::Ptr objectOf(
    const mrpt::obs::CObservation::Ptr& scan,
    const std::optional<observations::CloudClass>& cloud_class);

/// Has the clouds of an entry that were read as CGenericPointsMap written as such, with all fields.
void keepFields(mrpt::serialization::CSerializable& object);

}  // namespace hagen::logs
