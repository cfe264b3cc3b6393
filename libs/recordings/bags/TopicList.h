#pragma once
#include "recordings/bags/BagFile.h"

#include <map>
#include <stdexcept>
#include <string>
#include <tuple>
#include <vector>

namespace hagen::recordings {

/// The topics of a recording. Topics with several publishers are listed once.
class TopicList {
 public:
    /// Throws std::runtime_error if there are too many topics.
    std::size_t indexOf(const BagTopic& topic) {
        const auto key = std::tie(topic.name, topic.type, topic.encoding);
        const auto known = indices_.find(Key(key));
        if (known != indices_.end()) return known->second;
        if (topics_.size() >= kMaxTopics) throw std::runtime_error("there are too many topics");
        topics_.push_back(topic);
        return indices_[Key(key)] = topics_.size() - 1;
    }
    const std::vector<BagTopic>& all() const { return topics_; }

 private:
    using Key = std::tuple<std::string, std::string, std::string>;
    static constexpr std::size_t kMaxTopics = 65536;
    std::vector<BagTopic> topics_;
    std::map<Key, std::size_t> indices_;
};

}  // namespace hagen::recordings
