// The document that is made from the measurement.
#pragma once
#include <string>
#include <vector>

#include "Measurement.h"

namespace hagen {

/// What made the figures.
struct Provenance {
    std::string revision;  ///< of the project
    std::vector<std::uint64_t> seeds;
    bool is_quick = false;
};

/// The Markdown of docs/results.md. The charts' files are named as drawResults() names them.
std::string documentOf(const std::vector<Measured>& scores, const std::vector<Measured>& times,
                       const Provenance& provenance);

}  // namespace hagen
