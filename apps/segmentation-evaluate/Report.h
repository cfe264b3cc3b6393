// Human-readable tables.
#pragma once
#include <string>

#include "evaluation/labelled_folders/Summary.h"

namespace hagen {

/// Tables up to 100 columns wide, with scores and run times of each method, and either the
/// breakdown of a single method's scores or, for several methods, their F1 by part.
std::string reportOf(const evaluation::Summary& summary);

}  // namespace hagen
