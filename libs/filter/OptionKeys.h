#pragma once
#include <hagen/filter/Options.h>
#include <string>
#include <variant>
#include <vector>

namespace hagen {

/// The paper's stages, our stages before the ground surface, and the ground surface with its
/// dependants.
enum class StageGroup { Paper, Own, Surface };

/// A row of the ablation: the value of a setting that switches a stage off.
struct Ablation {
    StageGroup group;
    std::string value;  ///< "zone" and "W" stand for the values of zone_m and window_size
    std::string what;   ///< name of the row
};

/// An option's settings key. Parsing, range checks, sweeps, `rawlog-segment --config-keys` and the
/// ablation all use this table.
struct OptionKey {
    std::string name, unit;
    double min, max;           ///< allowed range, both inclusive
    std::string what, symbol;  ///< one-line description; the paper's symbol or empty
    std::variant<float Options::*, int Options::*, bool Options::*, Seeds Options::*> field;
    std::string section;  ///< in settings files; "paper" for interpretations of the paper
    std::vector<Ablation> ablations = {};
};
const std::vector<OptionKey>& optionKeys();

/// The name including the section: "paper.seeds".
std::string nameInFiles(const OptionKey& key);
/// The value of an option in settings-file syntax: "20", "true", "lowest".
std::string textOf(const OptionKey& key, const Options& options);
/// The allowed values in a settings file: "0.1 ... 1000", "lowest, top_and_nearest".
std::string rangeOf(const OptionKey& key);

}  // namespace hagen
