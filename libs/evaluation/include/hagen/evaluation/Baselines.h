#pragma once
#include <hagen/scan/Label.h>
#include <hagen/scan/Scan.h>
#include <hagen/scan/SensorModel.h>
#include <functional>
#include <string>
#include <vector>

namespace hagen::evaluation {

/// A published segmenter, ready to run, to compare the filter with.
struct Baseline {
    std::string name;        ///< short, for a row of a table
    std::string source;      ///< authors and publication
    std::string parameters;  ///< as text
    /// Returns one label per return: Unclassified outside the sensor's range limits, otherwise Rou
    /// or Roi. No state carries over between calls.
    std::function<std::vector<Label>(const Scan&, const SensorModel&)> segment;
};

/// Returns all baselines of this library, each with published and with tuned parameters (on
/// labelled scans); docs/baselines.md lists both. Returns farther than `zone_m` are ROU, as with
/// the filter.
std::vector<Baseline> baselines(float zone_m);

}  // namespace hagen::evaluation
