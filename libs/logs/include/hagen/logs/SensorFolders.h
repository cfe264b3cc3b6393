#pragma once
#include <hagen/base/OutputPath.h>
#include <filesystem>
#include <map>
#include <string>

namespace hagen::logs {

/// An output folder with a part for each sensor of a log: DIR/LABEL/, or DIR itself where
/// the log has but one. Appears under its name when whole.
class SensorFolders {
 public:
    /// Throws std::runtime_error, naming the folder; see OutputPath.
    SensorFolders(const std::filesystem::path& folder, const base::OutputKind& kind,
                  bool overwrite);

    /// Where to write what belongs to this sensor until commit(); made when first asked for.
    /// Characters that do not go into file names become '_'.
    const std::filesystem::path& folderOf(const std::string& sensor_label);

    void commit();
    std::filesystem::path keepPartial();

 private:
    void liftOnlyOne();

    base::OutputPath path_;
    std::map<std::string, std::filesystem::path> folders_;  ///< by sensor label
};

}  // namespace hagen::logs
