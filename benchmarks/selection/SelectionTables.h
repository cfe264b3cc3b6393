// Markdown tables of a selection: printed by select-settings, and part of docs/results.md.
#pragma once
#include <string>

#include "Record.h"

namespace hagen::selection {

/// Left-out scores per drive and their mean with its interval, by the first search; below them
/// those of other searches, and of settings that were chosen on the same drives.
std::string scoreTable(const Record& record);
/// Only the means and the intervals of RoI, one row per kind of data.
std::string meanTable(const Record& record);
/// The values chosen with all drives and without each; bold where they differ from the present
/// ones.
std::string choiceTable(const Record& record, const Search& search);
/// Objective and missed returns of each descent, before and after.
std::string foldTable(const Search& search);

}  // namespace hagen::selection
