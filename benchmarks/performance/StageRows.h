// The timed rows: each stage of the filter, the complete filter, and references.
#pragma once
#include <hagen/filter/HagenFilter.h>
#include <functional>
#include <string>
#include <vector>

#include "Inputs.h"

namespace hagen {

/// A scan and the results of each stage, which are the input of the next stage. Stages do not
/// modify their input, so all runs of a stage do the same work.
struct Case {
    Case(const Input& input, std::size_t which, const Options& with);

    mrpt::obs::CObservationVelodyneScan::Ptr packets;  ///< if null, `scan` has the coordinates
    SensorModel sensor;
    Options options;
    PixelDirections directions;
    HagenFilter filter;
    Scan scan;
    SegmentationResult result;
    std::vector<Label> floor_labels;
};

/// Computes beams, azimuths and ranges from the sensor's data.
void readReturns(Case& one);

struct StageRow {
    std::string what;
    bool with_paper_settings;
    bool needs_packets;
    std::function<void(Case&)> run;
};

/// Returns all rows: "mrpt decode" (MRPT's own decoder, which reads half of each scan), "floor"
/// (reads every input byte once and writes one label per return), "zermas ground fit"; the stages
/// of the paper and our own; "paper pipeline" and "default pipeline", from packets (or coordinates)
/// to labels and index lists.
const std::vector<StageRow>& stageRows();

/// The settings of config/paper.yaml.
Options paperOptions();

}  // namespace hagen
