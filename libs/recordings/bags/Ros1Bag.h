#pragma once
#include <hagen/recordings/BagFile.h>

#include <map>

#include "recordings/bags/FieldReader.h"
#include "recordings/bags/FileBytes.h"
#include "recordings/bags/TopicList.h"

namespace hagen::recordings {

/// A bag of ROS 1, format 2.0 (http://wiki.ros.org/Bags/Format/2.0), read record by record. Its
/// index is not needed; that it is there tells that the bag is whole.
class Ros1Bag : public BagFile {
 public:
    static bool isOne(const std::string& start);
    explicit Ros1Bag(const std::filesystem::path& file);

    bool next(BagMessage& message) override;
    const std::vector<BagTopic>& topics() const override { return topics_.all(); }
    double fractionRead() const override { return file_.fractionRead(); }

 private:
    using Fields = std::map<std::string, std::string>;

    bool readRecord(BagMessage& message);
    void readBagHeader(const Fields& fields);
    void readChunk(const Fields& fields);
    bool readInChunk(BagMessage& message);
    void takeConnection(const Fields& fields, ByteView data);
    bool takeMessage(const Fields& fields, ByteView data, BagMessage& message) const;
    void checkEnd() const;

    FileBytes file_;
    TopicList topics_;
    std::map<std::uint32_t, std::size_t> topic_of_;  ///< by connection
    std::uint64_t record_at_ = 0;                    ///< byte of the record that is being read
    std::vector<std::uint8_t> header_, data_, chunk_;
    FieldReader in_chunk_{ByteView()};  ///< what is left of the chunk, in the buffers above
    bool has_header_ = false;
    std::uint64_t index_at_ = 0;
    std::uint32_t chunks_due_ = 0, chunks_ = 0, chunk_infos_ = 0;
};

}  // namespace hagen::recordings
