#include <hagen/base/ReadFile.h>
#include <hagen/recordings/BagFile.h>

#include <fstream>

#include "recordings/bags/BagFolder.h"
#include "recordings/bags/McapFile.h"
#include "recordings/bags/Ros1Bag.h"
#include "recordings/bags/SqliteBag.h"

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
    if (std::filesystem::is_directory(file_or_folder)) return BagFolder::isOne(file_or_folder);
    const std::string start = startOf(file_or_folder);
    return Ros1Bag::isOne(start) || McapFile::isOne(start) || SqliteBag::isOne(start);
}

std::unique_ptr<BagFile> openBag(const std::filesystem::path& file_or_folder) {
    if (std::filesystem::is_directory(file_or_folder)) {
        return std::make_unique<BagFolder>(file_or_folder);
    }
    const std::string start = startOf(file_or_folder);
    if (Ros1Bag::isOne(start)) return std::make_unique<Ros1Bag>(file_or_folder);
    if (McapFile::isOne(start)) return std::make_unique<McapFile>(file_or_folder);
    if (SqliteBag::isOne(start)) return std::make_unique<SqliteBag>(file_or_folder);
    throw BrokenBag(file_or_folder.string() +
                    ": is no ROS 1 bag, no MCAP and no database of a ROS 2 bag");
}

}  // namespace hagen::recordings
