#pragma once
#include <hagen/filter/Options.h>
#include <hagen/settings/Settings.h>

#include <memory>
#include <optional>

#include "PythonScan.h"

namespace hagen::python {

struct Segmented;

/// Segments scans of recordings, which may have several sensors and settings of their own. Two
/// implementations: with_mrpt/ and captures/.
class RecordedFilter {
 public:
    explicit RecordedFilter(const Settings& settings);
    ~RecordedFilter();

    /// The sensor and options used for a scan, until the next call.
    struct Used {
        const SensorModel* sensor;
        const Options* options;
    };
    /// Throws std::runtime_error with the reason if the scan cannot be read. Needs no GIL.
    Used segment(const PythonScan& scan, const std::optional<Attitude>& attitude,
                 Segmented& segmented);

 private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace hagen::python
