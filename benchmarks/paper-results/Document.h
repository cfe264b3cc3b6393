// The document generated from the measurements.
#pragma once
#include <string>
#include <vector>

#include "Measurement.h"

namespace hagen {

/// The provenance of the figures.
struct Provenance {
    std::string revision;  ///< of the project
    std::vector<std::uint64_t> seeds;
    bool is_quick = false;
};

/// Returns the Markdown of docs/results.md. The charts' files are named as by drawResults().
std::string documentOf(const std::vector<Measured>& scores, const std::vector<Measured>& times,
                       const Provenance& provenance);

}  // namespace hagen
