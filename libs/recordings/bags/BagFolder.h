#pragma once
#include <hagen/recordings/BagFile.h>

#include "recordings/bags/TopicList.h"

namespace hagen::recordings {

/// A ROS 2 bag as a folder: the files that metadata.yaml lists, one after the other; without
/// metadata, or with some that are damaged or of something else, its .mcap or .db3 files in the
/// order of their numbers.
class BagFolder : public BagFile {
 public:
    static bool isOne(const std::filesystem::path& folder);
    explicit BagFolder(const std::filesystem::path& folder);

    bool next(BagMessage& message) override;
    const std::vector<BagTopic>& topics() const override { return topics_.all(); }
    double fractionRead() const override;
    std::vector<std::string> remarks() const override { return remarks_; }

 private:
    /// Takes out files that are listed again, and tells of these and of those that are not listed.
    void checkList(const std::filesystem::path& folder);
    void openFile();

    std::vector<std::filesystem::path> files_;
    std::vector<std::string> remarks_;
    std::vector<double> share_before_;  ///< of all bytes, by file
    double bytes_ = 0;
    std::size_t file_ = 0;
    std::unique_ptr<BagFile> open_;      ///< null: none left
    std::vector<std::size_t> topic_of_;  ///< by the index in the open file
    TopicList topics_;
};

}  // namespace hagen::recordings
