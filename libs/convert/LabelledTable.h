#pragma once
#include <hagen/mrpt/ObservationSegmenter.h>
#include <hagen/mrpt/PointTable.h>
#include <mrpt/obs/CObservation.h>

#include <string>
#include <vector>

namespace hagen::convert {

/// Points with their labels.
struct LabelledTable {
    observations::PointTable table;
    std::vector<std::string> renamed;  ///< fields of the input, by their new names

    /// For the user.
    std::vector<std::string> remarks() const;
};

/// The points of a segmented scan with their labels: all fields of the observation's cloud, or x,
/// y, z, intensity, `time` [s] if it is known, and of a sensor's own packets `ring`, counted from
/// the lowest beam; then `label` (uint8: 0 unclassified, 1 ROU, 2 RoI) and `obstacle` (uint32: the
/// RoI component, 0 none). All points of the input are there, in its order; those that were no
/// returns have the label 0. Fields of the input with one of these names become `input_label`,
/// `input_obstacle`, or if the input has these, too, `input_label_`, `input_obstacle_`.
LabelledTable labelledTable(const observations::ObservationSegmenter::Output& segmented,
                            const mrpt::obs::CObservation& observation);

/// Replaces the two clouds of a result by clouds with all fields of the labelled table, and
/// `color_r`, `color_g`, `color_b` (uint8) in the colours of the results; see genericCloudOf(). Our
/// own `time` is `t`, as MRPT calls it.
void useCloudsWithFields(const mrpt::obs::CObservation& observation,
                         observations::ObservationSegmenter::Output& segmented);

}  // namespace hagen::convert
