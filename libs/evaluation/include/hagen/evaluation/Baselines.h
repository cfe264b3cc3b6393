#pragma once
#include <hagen/scan/Label.h>
#include <hagen/scan/Scan.h>
#include <hagen/scan/SensorModel.h>
#include <functional>
#include <string>
#include <vector>

namespace hagen::evaluation {

/// A published segmenter with parameters, to compare with the filter.
struct Baseline {
    std::string name;        ///< short name for tables
    std::string source;      ///< authors and publication
    std::string parameters;  ///< description of the parameters
    /// Returns one label per return: Unclassified outside the sensor's range limits, otherwise Rou
    /// or Roi. No state carries over between calls.
    std::function<std::vector<Label>(const Scan&, const SensorModel&)> segment;
    /// The limit for ground, such as "Th_dist_m", and the baseline with another value of it.
    std::string limit = {};
    std::function<Baseline(float)> withLimit = {};
};

/// Returns all baselines of this library, each with published parameters and with parameters tuned
/// on labelled scans; docs/baselines.md lists both. Returns farther than `zone_m` are ROU, as with
/// the filter.
std::vector<Baseline> baselines(float zone_m);

}  // namespace hagen::evaluation
