#pragma once
#include <hagen/recordings/BagFile.h>

#include <map>

#include "recordings/bags/FieldReader.h"
#include "recordings/bags/FileBytes.h"
#include "recordings/bags/TopicList.h"

namespace hagen::recordings {

/// An MCAP file (https://mcap.dev/spec), read record by record. Its summary is not needed. CRCs
/// that the file has are checked: of each chunk before its messages are given out, of the data and
/// of the summary at their ends.
class McapFile : public BagFile {
 public:
    static bool isOne(const std::string& start);
    explicit McapFile(const std::filesystem::path& file);

    bool next(BagMessage& message) override;
    const std::vector<BagTopic>& topics() const override { return topics_.all(); }
    double fractionRead() const override { return file_.fractionRead(); }

 private:
    bool readRecord(BagMessage& message);
    bool readInChunk(BagMessage& message);
    bool takeRecord(std::uint8_t op, ByteView content, BagMessage& message);
    void takeChunk(FieldReader fields);
    void takeChannel(FieldReader fields);
    bool takeMessage(FieldReader fields, BagMessage& message) const;
    void checkDataCrc(FieldReader fields, std::uint32_t crc);
    void readFooter(std::uint64_t size);

    FileBytes file_;
    TopicList topics_;
    std::map<std::uint16_t, std::string> schemas_;
    std::map<std::uint16_t, std::size_t> topic_of_;  ///< by channel
    std::uint64_t record_at_ = 0;                    ///< byte of the record that is being read
    std::vector<std::uint8_t> head_, content_, chunk_;
    FieldReader in_chunk_{ByteView()};  ///< what is left of the chunk, in the buffers above
    bool is_data_ended_ = false, is_at_end_ = false;
    std::uint64_t summary_at_ = 0;
};

}  // namespace hagen::recordings
