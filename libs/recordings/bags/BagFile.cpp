#include "recordings/bags/BagFile.h"
#include "base/ReadFile.h"

#include "recordings/bags/BagFormats.h"

namespace hagen::recordings {
namespace {

std::string startOf(const std::filesystem::path& file) {
    std::string start(16, '\0');
    std::ifstream stream = base::openToRead(file);
    stream.read(start.data(), static_cast<std::streamsize>(start.size()));
    start.resize(static_cast<std::size_t>(stream.gcount()));
    return start;
}

}  // namespace

std::string typeAsInRos1(std::string type) {
    const std::size_t at = type.find("/msg/");
    if (at != std::string::npos) type.erase(at, 4);
    return type;
}

bool isBag(const std::filesystem::path& file_or_folder) {
    if (std::filesystem::is_directory(file_or_folder)) return isBagFolder(file_or_folder);
    const std::string start = startOf(file_or_folder);
    return isRos1Bag(start) || isMcap(start) || isSqliteBag(start);
}

std::unique_ptr<BagFile> openBag(const std::filesystem::path& file_or_folder) {
    if (std::filesystem::is_directory(file_or_folder)) return openBagFolder(file_or_folder);
    const std::string start = startOf(file_or_folder);
    if (isRos1Bag(start)) return openRos1Bag(file_or_folder);
    if (isMcap(start)) return openMcap(file_or_folder);
    if (isSqliteBag(start)) return openSqliteBag(file_or_folder);
    throw BrokenRecording(file_or_folder.string() +
                          ": is neither a ROS 1 bag, nor an MCAP, nor a database of a ROS 2 bag");
}

}  // namespace hagen::recordings
