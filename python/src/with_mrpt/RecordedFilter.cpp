#include "RecordedFilter.h"

#include <hagen/mrpt/ObservationSegmenter.h>

#include "Filter.h"
#include "with_mrpt/Recorded.h"

namespace hagen::python {

struct RecordedFilter::State {
    Settings settings;
    std::weak_ptr<const recordings::ScanSource> source;
    std::unique_ptr<observations::ObservationSegmenter> segmenter;
};

RecordedFilter::RecordedFilter(const Settings& settings)
    : state_(std::make_unique<State>(State{settings, {}, {}})) {}
RecordedFilter::~RecordedFilter() = default;

RecordedFilter::Used RecordedFilter::segment(const PythonScan& scan,
                                             const std::optional<Attitude>& attitude,
                                             Segmented& segmented) {
    auto& [settings, source, segmenter] = *state_;
    const Recorded& recorded = *scan.recorded;
    // Compares owners, because a destroyed recording is not the same as no recording.
    const bool is_same =
        !source.owner_before(recorded.source) && !recorded.source.owner_before(source);
    if (!segmenter || !is_same) {
        segmenter = std::make_unique<observations::ObservationSegmenter>();
        segmenter->setMinLoggingLevel(mrpt::system::LVL_ERROR);  // stored in remarks
        segmenter->initialize(recorded.source ? recorded.source->settingsFor(settings) : settings);
        source = recorded.source;
    }
    observations::ScanPose pose = recorded.scan.pose;
    if (attitude) {
        pose.attitude = attitude;
        pose.attitude_is_of_sensor = true;
    }
    observations::ObservationSegmenter::Output out;
    try {
        segmenter->process(*recorded.scan.observation, out, pose, recorded.scan.beams);
    } catch (...) {
        segmenter.reset();
        throw;
    }
    segmented.scan = *out.scan;
    segmented.result = *out.result;
    segmented.sensor = out.sensor->name;
    segmented.remark = out.remark;
    return {out.sensor, out.options};
}

}  // namespace hagen::python
