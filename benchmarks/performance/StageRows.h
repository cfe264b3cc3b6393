// The timed rows: the complete filter, each stage, and references.
#pragma once
#include <hagen/filter/HagenFilter.h>
#include <functional>
#include <string>
#include <vector>

#include "Inputs.h"

namespace hagen {

/// A filter, its current scan, and the results of each stage, which are the input of the next
/// stage.
struct Case {
    Case(const Input& from, const Options& with);
    /// Copies the scan's coordinates or packets, as if they had just arrived.
    void load(std::size_t which);
    /// Sets the scan and the results of all stages.
    void loadResults(std::size_t which);

    const Input* input;
    mrpt::obs::CObservationVelodyneScan::Ptr packets;
    Options options;
    PixelDirections directions;
    HagenFilter filter;
    Scan scan;
    SegmentationResult result;
};

struct StageRow {
    std::string what;
    std::function<void(Case&)> run;
};

/// Rows that share a case.
struct StageGroup {
    Options options;
    std::vector<StageRow> rows;
};

inline const std::string kMrptDecode = "mrpt decode", kPaperPipeline = "paper",
                         kDefaultPipeline = "default", kFastPipeline = "fast";

/// From packets or coordinates to labels and index lists, one row per group: kMrptDecode (only
/// MRPT's own decoder, which reads half of each scan; requires packets), kPaperPipeline,
/// kDefaultPipeline, kFastPipeline (raw_angles) and "zermas".
std::vector<StageGroup> pipelines();

/// The paper's stages with its settings, and our own with the default settings.
std::vector<StageGroup> stages();

/// The settings of config/paper.yaml.
Options paperOptions();
Options fastOptions();

}  // namespace hagen
