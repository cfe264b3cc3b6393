#pragma once
#include <hagen/mrpt/ObservationScan.h>
#include <mrpt/obs/CObservation.h>
#include <mrpt/serialization/CSerializable.h>

#include <optional>

namespace hagen::recordings {

/// The form of a scan of a capture, a bag or a live sensor in an output rawlog: packets as they
/// are, a cloud of the class asked for; null if none is asked for.
mrpt::serialization::CSerializable::Ptr objectOf(
    const mrpt::obs::CObservation::Ptr& scan,
    const std::optional<observations::CloudClass>& cloud_class);

}  // namespace hagen::recordings
