#pragma once
#include <hagen/avoidance/RunTable.h>
#include <functional>
#include <string>
#include <vector>

namespace hagen::avoidance {

/// A column of runs.csv.
struct RunColumn {
    const char* name;
    std::function<std::string(const Run&)> write;
    std::function<void(const std::string&, Run&)> read;  ///< throws std::runtime_error
    bool is_key = false;                                 ///< part of what identifies a run
    /// What holds for all runs of older tables, which lack the column; empty: no table lacks it.
    std::string before{};
    /// Tables in which `before` holds for all runs have no such column.
    bool is_optional = false;
};

/// All columns, in their order in the table. Those that older tables lack are last.
const std::vector<RunColumn>& runColumns();

}  // namespace hagen::avoidance
