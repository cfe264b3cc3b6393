#include <yaml-cpp/yaml.h>
#include "base/Folder.h"
#include "base/ReadFile.h"
#include "base/Text.h"

#include <algorithm>
#include <optional>
#include <set>
#include <utility>

#include "recordings/bags/BagFormats.h"
#include "recordings/bags/TopicList.h"

namespace hagen::recordings {
namespace {

namespace fs = std::filesystem;
constexpr const char* kMetadata = "metadata.yaml";
constexpr const char* kSection = "rosbag2_bagfile_information";
constexpr std::size_t kMaxMetadata = 2 << 20;

struct Metadata {
    std::optional<YAML::Node> bag;
    std::string why_none;  ///< why `files` cannot be used; empty if the file is missing
};

Metadata metadataOf(const fs::path& folder) {
    const fs::path file = folder / kMetadata;
    std::error_code none;
    if (!fs::is_regular_file(file, none)) return {};
    try {
        const YAML::Node all = YAML::Load(base::readText(file, kMaxMetadata));
        if (all.IsMap() && all[kSection] && all[kSection].IsMap()) return {all[kSection], ""};
    } catch (const std::exception& e) {
        return {std::nullopt, e.what()};
    }
    return {std::nullopt, std::string("it has no section '") + kSection + "'"};
}

std::vector<fs::path> listedFiles(const fs::path& folder, const YAML::Node& bag) {
    const std::string metadata = (folder / kMetadata).string();
    std::vector<fs::path> files;
    try {
        if (bag["compression_mode"] && bag["compression_format"] &&
            bag["compression_mode"].as<std::string>() == "FILE") {
            throw std::runtime_error("its files are compressed as a whole (" +
                                     bag["compression_format"].as<std::string>() +
                                     "): decompress them, for example with 'zstd -d', set "
                                     "compression_mode to NONE, and update the file names");
        }
        for (const YAML::Node& name : bag["relative_file_paths"]) {
            // Old versions prepend the folder's own name. Ignoring folders keeps files within the
            // bag.
            files.push_back(folder / fs::path(name.as<std::string>()).filename());
        }
    } catch (const std::exception& e) {
        throw BrokenRecording(metadata + ": cannot be read: " + e.what());
    }
    if (files.empty()) throw BrokenRecording(metadata + ": lists no files");
    for (const fs::path& listed : files) {
        if (fs::is_regular_file(listed)) continue;
        throw BrokenRecording(metadata + ": lists '" + listed.filename().string() +
                              "', which is not in the folder");
    }
    return files;
}

bool isOfBag(const fs::path& file) {
    const std::string ending = base::lowerCase(file.extension().string());
    return ending == ".mcap" || ending == ".db3";
}

std::vector<fs::path> foundFiles(const fs::path& folder) {
    std::vector<fs::path> files;
    for (const fs::path& file : base::entriesOf(folder)) {
        if (!fs::is_directory(file) && isOfBag(file)) files.push_back(file);
    }
    // Sorts flight_2 before flight_10.
    std::stable_sort(files.begin(), files.end(), [](const fs::path& a, const fs::path& b) {
        return a.filename().string().size() < b.filename().string().size();
    });
    return files;
}

class BagFolder : public BagFile {
 public:
    explicit BagFolder(const fs::path& folder) {
        const Metadata metadata = metadataOf(folder);
        if (metadata.bag) {
            useList(folder, listedFiles(folder, *metadata.bag));
        } else {
            files_ = foundFiles(folder);
        }
        if (files_.empty()) {
            throw BrokenRecording(folder.string() + ": has no .mcap and no .db3 files");
        }
        if (!metadata.why_none.empty()) {
            remarks_.push_back(std::string(kMetadata) + " is ignored (" + metadata.why_none +
                               "): the .mcap and .db3 files of the folder are read in the order "
                               "of their numbers");
        }
        for (const fs::path& file : files_) {
            bytes_before_.push_back(bytes_);
            bytes_ += static_cast<double>(fs::file_size(file));
        }
        openFile();
    }

    bool next(BagMessage& message) override {
        while (open_) {
            if (open_->next(message)) {
                const std::vector<BagTopic>& topics = open_->topics();
                while (topic_of_.size() < topics.size()) {
                    topic_of_.push_back(topics_.indexOf(topics[topic_of_.size()]));
                }
                message.topic = topic_of_[message.topic];
                return true;
            }
            damage_ += open_->takeDamage();
            open_.reset();
            if (++file_ < files_.size()) openFile();
        }
        return false;
    }

    std::string takeDamage() override {
        return std::exchange(damage_, "") + (open_ ? open_->takeDamage() : "");
    }
    const std::vector<BagTopic>& topics() const override { return topics_.all(); }

    double fractionRead() const override {
        if (!open_ || bytes_ <= 0) return 1.0;
        const double after = file_ + 1 < files_.size() ? bytes_before_[file_ + 1] : bytes_;
        const double size = after - bytes_before_[file_];
        return (bytes_before_[file_] + open_->fractionRead() * size) / bytes_;
    }

    std::vector<std::string> remarks() const override { return remarks_; }

 private:
    /// Reads each listed file once. Reports unlisted files.
    void useList(const fs::path& folder, const std::vector<fs::path>& listed) {
        std::set<fs::path> known;
        for (const fs::path& file : listed) {
            if (known.insert(file).second) files_.push_back(file);
        }
        std::string unlisted;
        for (const fs::path& file : foundFiles(folder)) {
            if (known.count(file) == 0) unlisted += " '" + file.filename().string() + "'";
        }
        if (unlisted.empty()) return;
        remarks_.push_back(std::string(kMetadata) +
                           " does not list all files in the folder; ignored:" + unlisted +
                           " ('ros2 bag reindex' creates a new list)");
    }

    void openFile() {
        open_ = openBag(files_[file_]);
        open_->checkWhileReading([this] { check(); });
        topic_of_.clear();
    }

    std::vector<fs::path> files_;
    std::string damage_;  ///< at the end of earlier files
    std::vector<std::string> remarks_;
    std::vector<double> bytes_before_;
    double bytes_ = 0;
    std::size_t file_ = 0;
    std::unique_ptr<BagFile> open_;      ///< null if no files are left
    std::vector<std::size_t> topic_of_;  ///< topic index by index in the open file
    TopicList topics_;
};

}  // namespace

bool isBagFolder(const fs::path& folder) {
    std::error_code none;
    if (metadataOf(folder).bag) return true;
    // Without metadata, the file names decide.
    return !fs::exists(folder / "velodyne", none) && !foundFiles(folder).empty();
}

std::unique_ptr<BagFile> openBagFolder(const fs::path& folder) {
    return std::make_unique<BagFolder>(folder);
}

}  // namespace hagen::recordings
