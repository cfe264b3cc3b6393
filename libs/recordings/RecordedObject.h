#pragma once
#include <hagen/mrpt/ObservationScan.h>
#include <mrpt/obs/CObservation.h>
#include <mrpt/serialization/CSerializable.h>

#include <optional>

namespace hagen::recordings {

/// Converts a scan of a capture, a bag or a live sensor to an object of an output rawlog. Packets
/// stay unchanged; clouds get the requested class, or become null if no class is requested.
mrpt::serialization::CSerializable::Ptr objectOf(
    const mrpt::obs::CObservation::Ptr& scan,
    const std::optional<observations::CloudClass>& cloud_class);

}  // namespace hagen::recordings
