// Labelled scan folders as sources of an evaluation.
#pragma once
#include <hagen/evaluation/Evaluation.h>
#include <optional>
#include <string>
#include <vector>

#include "evaluation/labelled_folders/Methods.h"

namespace hagen::evaluation {

/// Opens labelled scan folders. Ground-truth labels are read from labels/; with a label map, they
/// are derived from the classes in semantic/, or in labels/ if there is no semantic/. Class names
/// come from the map, otherwise from the folder's kinds.yaml. Throws std::runtime_error naming a
/// folder without scans, and SettingsError for a duplicate folder.
LabelledScanSources sourcesOf(const std::vector<std::string>& folders, const MethodSet& rows,
                              const std::optional<LabelMap>& label_map);

/// The settings merged with those of the recording and adapted to its recovered sensor. `source`
/// must come from sourcesOf().
Settings settingsOf(const LabelledScanSource& source, const Settings& asked);

}  // namespace hagen::evaluation
