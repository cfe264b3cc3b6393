#include "convert/SegmentEntry.h"

#include <hagen/mrpt/MrptMessage.h>
#include <mrpt/obs/CSensoryFrame.h>
#include "convert/RawlogWriter.h"
#include "mrpt/Results.h"
#include "mrpt/ScenePreview.h"

#include <algorithm>
#include <new>

#include "convert/LabelledTable.h"
#include "recordings/ScanObject.h"

namespace hagen::convert {
namespace {

using mrpt::obs::CObservation;
using observations::CloudClass;
using observations::ObservationSegmenter;

void segmentScan(const Conversion& conversion, const Settings& settings,
                 ObservationSegmenter& segmenter, ConvertedScan& scan) {
    const CObservation& observation = *scan.recorded.observation;
    try {
        scan.is_segmented =
            segmenter.process(observation, scan.segmented, scan.recorded.pose, scan.recorded.beams);
    } catch (const SettingsError&) {
        throw;
    } catch (const std::bad_alloc&) {
        throw;
    } catch (const std::exception& e) {
        scan.unreadable_because = observations::messageOf(e);
        if (scan.unreadable_because.empty()) scan.unreadable_because = "no reason given by MRPT";
    }
    if (!scan.is_segmented || conversion.rawlog.empty()) return;
    if (conversion.cloud_class == CloudClass::Generic) {
        useCloudsWithFields(observation, scan.segmented);
    }
    if (conversion.preview) {
        scan.preview =
            observations::previewOf(observation, scan.segmented, settings.options.zone_m);
    }
}

/// Removes an earlier run's results from a sensory frame. Keeps results of other LiDARs and of
/// scans that could not be segmented this time.
void removeOldResults(ConvertedEntry& entry) {
    const auto frame = std::dynamic_pointer_cast<mrpt::obs::CSensoryFrame>(entry.object);
    if (!frame) return;
    const auto isReplaced = [&](const CObservation& part) {
        return observations::isResult(part) &&
               std::any_of(entry.scans.begin(), entry.scans.end(), [&](const ConvertedScan& scan) {
                   const CObservation& of = *scan.recorded.observation;
                   return scan.is_segmented && of.timestamp == part.timestamp &&
                          of.sensorLabel == observations::scanLabelOf(part);
               });
    };
    for (auto part = frame->begin(); part != frame->end();) {
        const bool is_replaced = isReplaced(**part);
        entry.results_replaced += is_replaced;
        part = is_replaced ? frame->erase(part) : std::next(part);
    }
}

/// Serialises the object, followed by the results, which in a sensory frame are inside the object.
void serialiseEntry(CloudClass cloud_class, ConvertedEntry& entry) {
    if (entry.object && cloud_class == CloudClass::Generic) recordings::keepFields(entry.object);
    std::vector<CObservation::Ptr> added;
    for (const ConvertedScan& scan : entry.scans) {
        if (!scan.is_segmented) continue;
        added.push_back(scan.segmented.roi);
        added.push_back(scan.segmented.non_roi);
        if (scan.preview) added.push_back(scan.preview);
    }
    if (const auto frame = std::dynamic_pointer_cast<mrpt::obs::CSensoryFrame>(entry.object)) {
        for (const CObservation::Ptr& observation : added) frame->insert(observation);
        added.clear();
    }
    if (entry.object) serialise(*entry.object, entry.bytes);
    for (const CObservation::Ptr& observation : added) serialise(*observation, entry.bytes);
}

}  // namespace

std::unique_ptr<ObservationSegmenter> makeSegmenter(const Conversion& conversion,
                                                    const Settings& settings) {
    auto segmenter = std::make_unique<ObservationSegmenter>();
    segmenter->setMinLoggingLevel(mrpt::system::LVL_ERROR);  // the listener gets the remarks
    // Clouds with all fields need the observation's fields, so they are created afterwards.
    const bool is_generic = conversion.cloud_class == CloudClass::Generic;
    segmenter->cloud_class = is_generic ? CloudClass::Simple : conversion.cloud_class;
    Settings asking = settings;
    asking.options.number_obstacles = true;
    segmenter->initialize(asking);
    return segmenter;
}

void segmentEntry(const Conversion& conversion, const Settings& settings, Segmenters& segmenters,
                  ConvertedEntry& entry) {
    std::map<std::string, int> scans_of;
    for (ConvertedScan& scan : entry.scans) {
        const std::string& label = scan.recorded.observation->sensorLabel;
        auto& segmenter = segmenters[{label, scans_of[label]++}];
        if (!segmenter) segmenter = makeSegmenter(conversion, settings);
        segmentScan(conversion, settings, *segmenter, scan);
    }
    removeOldResults(entry);
    entry.bytes.clear();
    if (!conversion.rawlog.empty()) serialiseEntry(conversion.cloud_class, entry);
}

}  // namespace hagen::convert
