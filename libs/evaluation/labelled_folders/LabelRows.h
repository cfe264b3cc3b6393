// Labels of the same scans by other programs, scored like the filter's.
#pragma once
#include <hagen/evaluation/Method.h>
#include <hagen/recordings/ScanFolder.h>
#include <filesystem>
#include <string>
#include <vector>

namespace hagen::evaluation {

/// The name of such a row, and the folder of its label files.
struct LabelRow {
    std::string name;
    std::filesystem::path folder;
};

/// Parses "NAME=DIR". `taken` are the names of all other rows. Throws SettingsError if there is no
/// '=', no name, no such folder, or if the name is taken.
LabelRow labelRowFrom(const std::string& text, const std::vector<std::string>& taken);

/// Returns the folder with the label files (NNNNNN.label) of a scan folder that tables call
/// `scans_name`: the row's folder or its labels/ if this is the only evaluated scan folder
/// (`is_only`), or DIR/SCANS_NAME or DIR/SCANS_NAME/labels in any case. Throws std::runtime_error
/// naming the file if a scan has none.
std::filesystem::path labelFilesOf(const LabelRow& row, const recordings::ScanFolder& scans,
                                   const std::string& scans_name, bool is_only);

/// A method that reads the labels of each scan from `folder`/NAME.label (uint32 per return; the low
/// 16 bits are the label: 0 unclassified, 1 ROU, 2 RoI), where NAME is ScanInput::name. It throws
/// std::runtime_error naming the file if that cannot be read, has another number of labels than the
/// scan has returns, or another label.
Method labelFileMethod(const std::string& name, const std::filesystem::path& folder);

}  // namespace hagen::evaluation
