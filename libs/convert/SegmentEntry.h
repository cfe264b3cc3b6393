#pragma once
#include <hagen/convert/Conversion.h>
#include <hagen/mrpt/ObservationSegmenter.h>
#include <hagen/recordings/ScanSource.h>
#include "convert/GzipOutput.h"

#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace hagen::convert {

/// A scan during its conversion.
struct ConvertedScan {
    recordings::RecordedScan recorded;
    bool is_segmented = false;                             ///< `segmented` is valid
    std::string unreadable_because;                        ///< why the scan could not be read
    observations::ObservationSegmenter::Output segmented;  ///< points into the segmenter
    mrpt::obs::CObservation::Ptr preview;
};

/// An entry during its conversion. Reused for later entries.
struct ConvertedEntry {
    double fraction_read = 0;
    mrpt::serialization::CSerializable::Ptr object;  ///< null if only scans are written
    std::vector<ConvertedScan> scans;
    std::size_t results_replaced = 0;  ///< results of an earlier run removed from the object
    Bytes bytes;                       ///< for the output rawlog
};

/// One per scan of an entry, because results point into it, by sensor label and number in the
/// entry.
using Segmenters =
    std::map<std::pair<std::string, int>, std::unique_ptr<observations::ObservationSegmenter>>;

/// Throws SettingsError if settings and sensor are inconsistent.
std::unique_ptr<observations::ObservationSegmenter> makeSegmenter(const Conversion& conversion,
                                                                  const Settings& settings);

/// Segments the scans of an entry and, for an output rawlog, replaces an earlier run's results and
/// serialises the entry. Throws SettingsError and std::bad_alloc; other errors of a scan are in
/// `unreadable_because`.
void segmentEntry(const Conversion& conversion, const Settings& settings, Segmenters& segmenters,
                  ConvertedEntry& entry);

}  // namespace hagen::convert
