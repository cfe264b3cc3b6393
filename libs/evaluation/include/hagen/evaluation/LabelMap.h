#pragma once
#include <hagen/scan/Label.h>
#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace hagen::evaluation {

/// A semantic class: its name and its label.
struct SemanticClass {
    std::string name;
    Label label = Label::Unclassified;
};

/// Semantic classes by number: the low 16 bits of an entry in a label file.
using LabelMap = std::map<std::uint16_t, SemanticClass>;

/// Reads a label map, the format of `--label-map` and of a scan folder's kinds.yaml: YAML, one line
/// per class, such as `72: {name: terrain, label: 1}`; label 0 (ignored), 1 (ROU) or 2 (RoI).
/// Throws std::runtime_error; the message names file, line and error.
LabelMap readLabelMap(const std::filesystem::path& file);

/// Returns the labels of classes. Throws std::invalid_argument naming a number that is not in the
/// map.
std::vector<Label> labelsOfClasses(const std::vector<std::uint16_t>& kinds, const LabelMap& map);

/// Converts the numbers in a label file to labels. Throws std::invalid_argument for numbers other
/// than 0, 1, 2.
std::vector<Label> labelsOfNumbers(const std::vector<std::uint16_t>& numbers);

}  // namespace hagen::evaluation
