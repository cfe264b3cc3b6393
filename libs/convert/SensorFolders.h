#pragma once
#include <hagen/base/OutputPath.h>
#include <filesystem>
#include <map>
#include <string>

namespace hagen::convert {

/// An output folder with one subfolder per sensor, DIR/LABEL/, or DIR itself if the log has only
/// one sensor. Renamed into place when complete.
class SensorFolders {
 public:
    /// Throws std::runtime_error naming the folder; see OutputPath.
    SensorFolders(const std::filesystem::path& folder, const base::OutputKind& kind,
                  bool overwrite);

    /// The folder of this sensor until commit(), created by the first call. Characters that are not
    /// allowed in file names become '_'.
    const std::filesystem::path& folderOf(const std::string& sensor_label);

    /// Renames the folder into place, unless it is empty.
    void commit();
    std::filesystem::path keepPartial();

 private:
    void unwrapOnlyFolder();
    void writeMarker() const;

    const char* marker_;  ///< marker file of the output kind; may be null
    base::OutputPath path_;
    std::map<std::string, std::filesystem::path> folders_;  ///< by sensor label
    bool is_unwrapped_ = false;  ///< the folder of the only sensor is the output
};

}  // namespace hagen::convert
