#include "convert/CloudOutput.h"

#include "recordings/clouds/CloudFile.h"

#include "convert/LabelledTable.h"

namespace hagen::convert {

namespace fs = std::filesystem;

// Only the marker distinguishes these clouds from the user's clouds, which may have the same names.
const base::OutputKind kClouds{"a folder of labelled clouds",
                               [](const fs::path& within) {
                                   return within.extension() == ".ply" ||
                                          within.extension() == ".pcd" ||
                                          within == recordings::kCloudsMarker;
                               },
                               recordings::kCloudsMarker};

void CloudChanges::add(const std::vector<std::string>& changes) {
    for (const std::string& change : changes) ++clouds_[change];
}

std::vector<std::string> CloudChanges::texts(std::size_t all_clouds) const {
    std::vector<std::string> texts;
    for (const auto& [change, clouds] : clouds_) {
        texts.push_back(change + (clouds == all_clouds
                                      ? ""
                                      : " (" + std::to_string(clouds) + " of " +
                                            std::to_string(all_clouds) + " clouds)"));
    }
    return texts;
}

CloudOutput::CloudOutput(const fs::path& folder, OutputFormat format, bool overwrite)
    : format_(format), folders_(folder, kClouds, overwrite) {}

void CloudOutput::write(const std::string& name,
                        const observations::ObservationSegmenter::Output& segmented,
                        const mrpt::obs::CObservation& observation) {
    const LabelledTable labelled = labelledTable(segmented, observation);
    const observations::PointTable& table = labelled.table;
    changes_.add(labelled.remarks());
    changes_.add(changesWhenWritten(format_, table));
    const fs::path file =
        folders_.folderOf(observation.sensorLabel) / (name + extensionOf(format_));
    try {
        writeCloud(file, format_, table);
    } catch (...) {  // removes the partial cloud
        std::error_code ignored;
        fs::remove(file, ignored);
        throw;
    }
    ++files_;
    points_ += table.points;
}

}  // namespace hagen::convert
