#pragma once
#include <hagen/range_image/Label.h>
#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace hagen::evaluation {

/// A kind of object that returns are of: what it is called, and the label that its returns have.
struct Kind {
    std::string name;
    Label label = Label::Unclassified;
};

/// Kinds by their number in the low 16 bits of a label file.
using LabelMap = std::map<std::uint16_t, Kind>;

/// Reads a label map, as `--label-map` and the kinds.yaml of a scan folder have it: YAML, a line a
/// kind, label 0 (left out), 1 (ROU) or 2 (RoI):
///
///     70: {name: vegetation, label: 2}
///     72: {name: terrain, label: 1}
///
/// Throws std::runtime_error, naming file, line and what is wrong.
LabelMap readLabelMap(const std::filesystem::path& file);

/// The labels of returns of these kinds. Throws std::invalid_argument, naming the number, for one
/// that is not in the map.
std::vector<Label> labelsOfKinds(const std::vector<std::uint16_t>& kinds, const LabelMap& map);

/// Label numbers, as a label file has them. Throws std::invalid_argument for any but 0, 1 and 2.
std::vector<Label> labelsOfNumbers(const std::vector<std::uint16_t>& numbers);

}  // namespace hagen::evaluation
