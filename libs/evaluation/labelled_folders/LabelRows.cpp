#include "evaluation/labelled_folders/LabelRows.h"
#include "base/NumberText.h"

#include <hagen/settings/Settings.h>
#include <algorithm>
#include "base/Folder.h"

namespace hagen::evaluation {
namespace {

namespace fs = std::filesystem;

bool hasLabelFiles(const fs::path& folder) {
    if (!fs::is_directory(folder)) return false;
    const std::vector<fs::path> files = base::entriesOf(folder);
    return std::any_of(files.begin(), files.end(),
                       [](const fs::path& file) { return file.extension() == ".label"; });
}

std::vector<Label> readFoundLabels(const fs::path& file, std::size_t returns) {
    const std::vector<std::uint16_t> numbers = recordings::readLabels(file);
    if (numbers.size() != returns) {
        throw std::runtime_error(file.string() + ": has " + base::counted(numbers.size(), "label") +
                                 " for " + base::counted(returns, "return") +
                                 "; write one per return, in the order of the scan's file");
    }
    std::vector<Label> labels;
    labels.reserve(numbers.size());
    for (std::size_t i = 0; i < numbers.size(); ++i) {
        if (numbers[i] > static_cast<std::uint16_t>(Label::Roi)) {
            throw std::runtime_error(file.string() + ": label " + std::to_string(i + 1) + " is " +
                                     std::to_string(numbers[i]) +
                                     "; write 0 (unclassified), 1 (ROU) or 2 (RoI)");
        }
        labels.push_back(static_cast<Label>(numbers[i]));
    }
    return labels;
}

}  // namespace

LabelRow labelRowFrom(const std::string& text, const std::vector<std::string>& taken) {
    const std::size_t equals = text.find('=');
    if (equals == std::string::npos || equals == 0 || equals + 1 == text.size()) {
        throw SettingsError("--labels: expected NAME=DIR, not '" + text + "'");
    }
    const LabelRow row{text.substr(0, equals), text.substr(equals + 1)};
    if (std::find(taken.begin(), taken.end(), row.name) != taken.end()) {
        throw SettingsError("--labels: there is already a row '" + row.name +
                            "'; choose another name");
    }
    if (!fs::is_directory(row.folder)) {
        throw SettingsError("--labels: " + row.folder.string() + ": no such folder");
    }
    return row;
}

fs::path labelFilesOf(const LabelRow& row, const recordings::ScanFolder& scans,
                      const std::string& scans_name, bool is_only) {
    std::vector<fs::path> places;
    if (is_only) places = {row.folder, row.folder / "labels"};
    places.insert(places.end(), {row.folder / scans_name, row.folder / scans_name / "labels"});
    const auto place = std::find_if(places.begin(), places.end(), hasLabelFiles);
    const fs::path folder = place == places.end() ? places.front() : *place;
    std::error_code no_such_folder;
    if (fs::equivalent(folder, scans.path() / "labels", no_such_folder)) {
        throw std::runtime_error(folder.string() + ": is the ground truth itself; --labels " +
                                 row.name + "=DIR requires the folder with the labels to score");
    }
    for (std::size_t i = 0; i < scans.size(); ++i) {
        const fs::path file = folder / (scans.name(i) + ".label");
        if (fs::is_regular_file(file)) continue;
        throw std::runtime_error(file.string() + ": no such file; --labels " + row.name +
                                 "=DIR requires a label file for " + scans.scanFile(i).string() +
                                 " (in DIR for a single input folder, otherwise in DIR/" +
                                 scans_name + ")");
    }
    return folder;
}

Method labelFileMethod(const std::string& name, const fs::path& folder) {
    Method method;
    method.name = name;
    method.is_recorded = true;
    method.segment = [folder](const ScanInput& input) {
        return readFoundLabels(folder / (input.name + ".label"), input.scan.size());
    };
    return method;
}

}  // namespace hagen::evaluation
