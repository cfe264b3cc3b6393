#pragma once
#include <hagen/range_image/Label.h>
#include <hagen/range_image/Scan.h>
#include <hagen/range_image/SensorModel.h>
#include <functional>
#include <string>
#include <vector>

namespace hagen::evaluation {

/// A published segmenter to stand beside the filter, ready to run.
struct Baseline {
    std::string name;        ///< short, for a row of a table
    std::string source;      ///< who published it, where
    std::string parameters;  ///< those it runs with
    /// An entry a return: Unclassified out of the sensor's range, else Rou or Roi. Keeps nothing
    /// between calls.
    std::function<std::vector<Label>(const Scan&, const SensorModel&)> segment;
};

/// All baselines of this library, each as published and as tuned on labelled scans;
/// docs/baselines.md tells them apart. Returns farther than `zone_m` are ROU, as with the filter.
std::vector<Baseline> baselines(float zone_m);

}  // namespace hagen::evaluation
