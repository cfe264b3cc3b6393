#pragma once
#include <hagen/segmentation/Options.h>
#include <string>
#include <variant>
#include <vector>

namespace hagen {

/// One key of a settings file that sets an option. Parsing, range checks, sweeps and
/// `rawlog-segment --config-keys` all use this table.
struct OptionKey {
    std::string name, unit;
    double least, most;        ///< allowed range, both included
    std::string what, symbol;  ///< what it does in a line; the paper's symbol, if it has one
    std::variant<float Options::*, int Options::*, bool Options::*, Seeds Options::*> field;
};
const std::vector<OptionKey>& optionKeys();

/// The value of an option, as written in a settings file: "20", "true", "lowest".
std::string textOf(const OptionKey& key, const Options& options);
/// The values that a settings file may have: "0.1 ... 1000", "lowest, top_and_nearest".
std::string rangeOf(const OptionKey& key);

}  // namespace hagen
