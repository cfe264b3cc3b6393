// Labelled scan folders as sources of an evaluation.
#pragma once
#include <hagen/evaluation/Evaluation.h>
#include <optional>
#include <string>
#include <vector>

#include "Methods.h"

namespace hagen::labelled_scans {

/// True labels are those of labels/, or with a map those that it gives to the classes in semantic/,
/// else labels/. Kinds are those of the map, else those of the folder's own kinds.yaml.
/// Throws std::runtime_error, naming the folder, where one holds no scans, and SettingsError where
/// one is given twice.
evaluation::LabelledScanSources sourcesOf(const std::vector<std::string>& folders,
                                          const MethodSet& rows,
                                          const std::optional<evaluation::LabelMap>& label_map);

}  // namespace hagen::labelled_scans
