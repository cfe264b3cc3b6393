// Tables of a selection, printed by select-settings and part of docs/results.md.
#pragma once
#include <string>

#include "Record.h"
#include "support/Tables.h"

namespace hagen::selection {

/// Scores of the first search per held-out drive, and their mean with its interval; then means of
/// other searches and in-sample settings.
std::string scoreTable(const Record& record);
/// Only the means and intervals of RoI, one row per kind of data.
std::string meanTable(const Record& record);
/// "real, 16 beams 0.948 / 0.975; ...": mean F1 over the held-out drives, from the first search.
std::string meanList(const Record& record);
/// The values chosen with all drives and with each drive held out; bold if changed.
Table choiceTable(const Record& record, const Search& search);
/// Objective and missed returns before and after each descent.
Table foldTable(const Search& search);

}  // namespace hagen::selection
