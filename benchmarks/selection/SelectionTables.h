// Tables of a selection: printed by select-settings, and part of docs/results.md.
#pragma once
#include <string>

#include "Record.h"
#include "support/Tables.h"

namespace hagen::selection {

/// Scores per held-out drive and their mean with its interval, by the first search; below them
/// those of other searches, and of settings that were chosen on the same drives.
std::string scoreTable(const Record& record);
/// Only the means and the intervals of RoI, one row per kind of data.
std::string meanTable(const Record& record);
/// "real, 16 beams 0.948 / 0.975; ...": mean F1 over the held-out drives, by the first search.
std::string meanList(const Record& record);
/// The values chosen with all drives and without each; bold where they differ from the present
/// ones.
Table choiceTable(const Record& record, const Search& search);
/// Objective and missed returns of each descent, before and after.
Table foldTable(const Search& search);

}  // namespace hagen::selection
