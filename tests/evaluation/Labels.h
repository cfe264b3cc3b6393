#pragma once
#include <hagen/scan/Label.h>

namespace hagen::evaluation {

/// Short names for tables of labels: ground, obstacle, unclassified.
constexpr auto G = Label::Rou, O = Label::Roi, U = Label::Unclassified;

}  // namespace hagen::evaluation
