// The tables for people.
#pragma once
#include <string>

#include "evaluation/labelled_folders/Summary.h"

namespace hagen {

/// Tables of at most 100 columns: scores and run times of each method; the parts of its scores if
/// there is only one method, otherwise F1 of each method by part.
std::string reportOf(const evaluation::Summary& summary);

}  // namespace hagen
