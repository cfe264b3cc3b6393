#include "recordings/bags/BagFolder.h"

#include <hagen/base/Folder.h>
#include <hagen/base/ReadFile.h>
#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <cctype>
#include <optional>
#include <set>

namespace hagen::recordings {
namespace {

namespace fs = std::filesystem;
constexpr const char* kMetadata = "metadata.yaml";
constexpr const char* kSection = "rosbag2_bagfile_information";
constexpr std::size_t kMostMetadata = 2 << 20;

/// What a metadata.yaml says about a bag.
struct Metadata {
    std::optional<YAML::Node> bag;
    std::string why_none;  ///< empty: there is no such file
};

Metadata metadataOf(const fs::path& folder) {
    const fs::path file = folder / kMetadata;
    std::error_code none;
    if (!fs::is_regular_file(file, none)) return {};
    try {
        const YAML::Node all = YAML::Load(base::readText(file, kMostMetadata));
        if (all.IsMap() && all[kSection] && all[kSection].IsMap()) return {all[kSection], ""};
    } catch (const std::exception& e) {
        return {std::nullopt, e.what()};
    }
    return {std::nullopt, std::string("it has no section '") + kSection + "'"};
}

std::vector<fs::path> listedFiles(const fs::path& folder, const YAML::Node& bag) {
    const fs::path file = folder / kMetadata;
    std::vector<fs::path> files;
    try {
        if (bag["compression_mode"] && bag["compression_format"] &&
            bag["compression_mode"].as<std::string>() == "FILE") {
            throw std::runtime_error("its files are packed whole (" +
                                     bag["compression_format"].as<std::string>() +
                                     "): unpack them, such as by 'zstd -d', and set "
                                     "compression_mode to NONE and the file names to theirs");
        }
        for (const YAML::Node& name : bag["relative_file_paths"]) {
            // Old versions wrote the folder's own name, too; none points elsewhere.
            files.push_back(folder / fs::path(name.as<std::string>()).filename());
        }
    } catch (const std::exception& e) {
        throw BrokenBag(file.string() + ": cannot be read: " + e.what());
    }
    if (files.empty()) throw BrokenBag(file.string() + ": lists no files");
    for (const fs::path& listed : files) {
        if (fs::is_regular_file(listed)) continue;
        throw BrokenBag(file.string() + ": lists '" + listed.filename().string() +
                        "', which is not in the folder");
    }
    return files;
}

bool isOfBag(const fs::path& file) {
    std::string ending = file.extension().string();
    for (char& c : ending) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    return ending == ".mcap" || ending == ".db3";
}

/// Files of a folder that may be recordings, too. Texts beside them are none.
std::vector<fs::path> otherFiles(const fs::path& folder) {
    static const std::set<std::string> texts{".yaml", ".yml", ".json", ".txt",    ".md", ".csv",
                                             ".tum",  ".log", ".xml",  ".launch", ".sh", ".rviz"};
    std::vector<fs::path> files;
    for (const fs::path& file : base::entriesOf(folder)) {
        const std::string name = file.filename().string();
        const bool is_of_sqlite = name.find(".db3-") != std::string::npos;
        if (fs::is_regular_file(file) && !isOfBag(file) && !is_of_sqlite && name[0] != '.' &&
            texts.count(file.extension().string()) == 0) {
            files.push_back(file);
        }
    }
    std::sort(files.begin(), files.end());
    return files;
}

std::vector<fs::path> foundFiles(const fs::path& folder) {
    std::vector<fs::path> files;
    for (const fs::path& file : base::entriesOf(folder)) {
        if (!fs::is_directory(file) && isOfBag(file)) files.push_back(file);
    }
    // flight_2 comes before flight_10.
    std::sort(files.begin(), files.end(), [](const fs::path& a, const fs::path& b) {
        const std::string x = a.filename().string(), y = b.filename().string();
        return x.size() != y.size() ? x.size() < y.size() : x < y;
    });
    return files;
}

/// "'a_1.mcap', 'a_2.mcap' and 3 more".
std::string textOf(const std::vector<fs::path>& files) {
    constexpr std::size_t kMost = 5;
    std::string text;
    for (std::size_t i = 0; i < std::min(kMost, files.size()); ++i) {
        text += (i == 0 ? "'" : ", '") + files[i].filename().string() + "'";
    }
    if (files.size() > kMost) text += " and " + std::to_string(files.size() - kMost) + " more";
    return text;
}

/// Takes out what a list has again, and returns it.
std::vector<fs::path> takeRepeated(std::vector<fs::path>& files) {
    std::set<fs::path> seen;
    std::vector<fs::path> once, repeated;
    for (const fs::path& file : files) (seen.insert(file).second ? once : repeated).push_back(file);
    files = std::move(once);
    return repeated;
}

/// The files of a folder that a list lacks.
std::vector<fs::path> unlistedFiles(const fs::path& folder, const std::vector<fs::path>& listed) {
    const std::set<fs::path> known(listed.begin(), listed.end());
    std::vector<fs::path> unlisted;
    for (const fs::path& file : foundFiles(folder)) {
        if (known.count(file) == 0) unlisted.push_back(file);
    }
    return unlisted;
}

}  // namespace

bool BagFolder::isOne(const fs::path& folder) {
    std::error_code none;
    if (metadataOf(folder).bag) return true;
    // Otherwise the files decide.
    return !fs::exists(folder / "velodyne", none) && !foundFiles(folder).empty();
}

BagFolder::BagFolder(const fs::path& folder) {
    const Metadata metadata = metadataOf(folder);
    files_ = metadata.bag ? listedFiles(folder, *metadata.bag) : foundFiles(folder);
    if (files_.empty()) {
        throw BrokenBag(folder.string() + ": has no .mcap and no .db3 files");
    }
    if (metadata.bag) checkList(folder);
    if (!metadata.why_none.empty()) {
        std::string& remark = remarks_.emplace_back(kMetadata);
        remark += " is not used (" + metadata.why_none +
                  "): the .mcap and .db3 files of the folder are read in the order of their "
                  "numbers";
    }
    if (const auto others = otherFiles(folder); !others.empty()) {
        remarks_.push_back("the folder has other files, which are not read: " + textOf(others));
    }
    for (const fs::path& file : files_) {
        share_before_.push_back(bytes_);
        bytes_ += static_cast<double>(fs::file_size(file));
    }
    openFile();
}

void BagFolder::checkList(const fs::path& folder) {
    if (const auto repeated = takeRepeated(files_); !repeated.empty()) {
        remarks_.push_back(std::string(kMetadata) + " lists files repeatedly: " + textOf(repeated) +
                           "; each is read once");
    }
    if (const auto unlisted = unlistedFiles(folder, files_); !unlisted.empty()) {
        remarks_.push_back(std::string(kMetadata) +
                           " does not list files of the folder: " + textOf(unlisted) +
                           "; they are not read ('ros2 bag reindex' makes a new list)");
    }
}

void BagFolder::openFile() {
    open_ = openBag(files_[file_]);
    open_->checkWhileReading([this] { check(); });
    topic_of_.clear();
}

bool BagFolder::next(BagMessage& message) {
    while (open_) {
        if (open_->next(message)) {
            const std::vector<BagTopic>& topics = open_->topics();
            while (topic_of_.size() < topics.size()) {
                topic_of_.push_back(topics_.indexOf(topics[topic_of_.size()]));
            }
            message.topic = topic_of_[message.topic];
            return true;
        }
        open_.reset();
        if (++file_ < files_.size()) openFile();
    }
    return false;
}

double BagFolder::fractionRead() const {
    if (!open_ || bytes_ <= 0) return 1.0;
    const double after = file_ + 1 < files_.size() ? share_before_[file_ + 1] : bytes_;
    const double size = after - share_before_[file_];
    return (share_before_[file_] + open_->fractionRead() * size) / bytes_;
}

}  // namespace hagen::recordings
