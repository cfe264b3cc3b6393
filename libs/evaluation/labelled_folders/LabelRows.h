// Labels of the same scans by other programs, scored like the filter's.
#pragma once
#include <hagen/evaluation/Method.h>
#include <hagen/recordings/ScanFolder.h>
#include <filesystem>
#include <string>
#include <vector>

namespace hagen::evaluation {

/// The name of a row and the folder of its label files.
struct LabelRow {
    std::string name;
    std::filesystem::path folder;
};

/// Parses "NAME=DIR". `taken`: names of all other rows. Throws SettingsError without '=' or name,
/// if the folder does not exist, or if the name is taken.
LabelRow labelRowFrom(const std::string& text, const std::vector<std::string>& taken);

/// Returns the folder with the label files (NNNNNN.label) for the scan folder shown as
/// `scans_name`: DIR/SCANS_NAME or DIR/SCANS_NAME/labels, or, for a single evaluated scan folder
/// (`is_only`), DIR or DIR/labels. Throws std::runtime_error naming the file if a scan has no
/// labels.
std::filesystem::path labelFilesOf(const LabelRow& row, const recordings::ScanFolder& scans,
                                   const std::string& scans_name, bool is_only);

/// A method that reads the labels of each scan from `folder`/NAME.label (uint32 per return; the low
/// 16 bits are the label: 0 unclassified, 1 ROU, 2 RoI), where NAME is ScanInput::name. Throws
/// std::runtime_error naming the file if it cannot be read, has a wrong number of labels, or has an
/// unknown label.
Method labelFileMethod(const std::string& name, const std::filesystem::path& folder);

}  // namespace hagen::evaluation
