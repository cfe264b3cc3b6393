// The tables that people read.
#pragma once
#include <string>

#include <hagen/labelled_scans/Summary.h>

namespace hagen {

/// Tables of at most 100 columns: scores and run times of each method, and where there is one
/// method alone the parts of its scores; where there are more, F1 of each by part.
std::string reportOf(const labelled_scans::Summary& summary);

}  // namespace hagen
