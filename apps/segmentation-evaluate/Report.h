// Human-readable tables.
#pragma once
#include <string>

#include "evaluation/labelled_folders/Summary.h"

namespace hagen {

/// Tables up to 100 columns wide: scores and run times of each method; the breakdown of its scores
/// if there is only one method, otherwise each method's F1 by part.
std::string reportOf(const evaluation::Summary& summary);

}  // namespace hagen
