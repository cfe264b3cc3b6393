#pragma once
#include <hagen/trials/RunTable.h>
#include <functional>
#include <string>
#include <vector>

namespace hagen::trials {

/// A column of runs.csv.
struct RunColumn {
    const char* name;
    std::function<std::string(const Run&)> write;
    std::function<void(const std::string&, Run&)> read;  ///< throws std::runtime_error
    bool is_key = false;                                 ///< part of what identifies a run
};

/// All columns, in their order in the table.
const std::vector<RunColumn>& runColumns();

}  // namespace hagen::trials
