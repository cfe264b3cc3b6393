#pragma once
#include "base/command_line/CommandLine.h"

#include <algorithm>
#include <sstream>
#include <string>
#include <vector>

namespace hagen {

using namespace base;  // Program, Command, Flag, UsageError

/// Lets a flag accept world models by name or by displayed name, such as W-RoI and "RoI window".
/// Rejects other values unless they are in `also`, and lists the names.
void takesWorldModels(Flag flag, const std::vector<std::string>& also = {});

/// Throws UsageError if a value occurs twice.
template <class Value>
void requireOnce(const std::string& flag, const std::vector<Value>& values) {
    for (auto value = values.begin(); value != values.end(); ++value) {
        if (std::find(values.begin(), value, *value) == value) continue;
        std::ostringstream text;
        text << *value;
        throw UsageError(flag, text.str() + " is given twice");
    }
}
/// Expands "all" to all names. Throws UsageError for duplicates, and for "all" together with other
/// names.
std::vector<std::string> namesFrom(const std::string& flag, const std::vector<std::string>& names,
                                   const std::vector<std::string>& all);

// Add a subcommand with its flags.
void addClosedLoop(Program& program);
void addCalibrate(Program& program);
void addOpenLoop(Program& program);
void addReplay(Program& program);

}  // namespace hagen
