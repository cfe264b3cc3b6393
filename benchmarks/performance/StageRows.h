// What is timed: each stage of the filter, the whole, and what it is held against.
#pragma once
#include <hagen/segmentation/HagenFilter.h>
#include <functional>
#include <string>
#include <vector>

#include "Inputs.h"

namespace hagen {

/// A scan, and what each stage made of it: the input of the next. Stages write where they read
/// nothing, so that a run of one is like the next.
struct Case {
    Case(const Input& input, std::size_t scan, const Options& with);

    mrpt::obs::CObservationVelodyneScan::Ptr packets;  ///< null: `scan` has its coordinates
    SensorModel sensor;
    Options options;
    PixelDirections directions;
    HagenFilter filter;
    Scan scan;
    SegmentationResult result;
    std::vector<Label> floor_labels;
};

/// From what the sensor sent to beams, azimuths and ranges.
void readReturns(Case& one);

struct StageRow {
    std::string what;
    bool with_paper_settings;
    bool needs_packets;
    std::function<void(Case&)> run;
};

/// "mrpt decode" (MRPT's own decoder, which reads half of each scan), "floor" (every byte of the
/// input read once, a label a return written), "zermas ground fit"; the stages of the paper and
/// those of our own; "paper pipeline" and "default pipeline", from packets (or coordinates) to
/// labels and lists of indices.
const std::vector<StageRow>& stageRows();

/// The settings of config/paper.yaml.
Options paperOptions();

}  // namespace hagen
