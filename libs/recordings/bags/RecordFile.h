#pragma once
#include "recordings/bags/BagFile.h"

#include <map>
#include <string>

#include "recordings/bags/FieldReader.h"
#include "recordings/bags/FileBytes.h"
#include "recordings/bags/TopicList.h"

namespace hagen::recordings {

/// A bag that consists of records. Some records are chunks, which contain records.
class RecordFile : public BagFile {
 public:
    bool next(BagMessage& message) final;
    std::string takeDamage() final;
    const std::vector<BagTopic>& topics() const final { return topics_.all(); }
    double fractionRead() const final { return is_at_end_ ? 1.0 : file_.fractionRead(); }

 protected:
    RecordFile(const std::filesystem::path& file, bool has_crc) : file_(file, has_crc) {}

    /// Reads the next record of the file or of in_chunk_. Returns true if it is a message. Throws
    /// std::runtime_error with the reason if it is invalid.
    virtual bool readRecord(BagMessage& message) = 0;
    virtual bool readInChunk(BagMessage& message) = 0;

    /// Fills a message and returns true. Throws std::runtime_error if its channel is unknown.
    bool take(const char* channel_name, std::uint32_t channel, std::int64_t time_ns, ByteView data,
              BagMessage& message) const;

    FileBytes file_;
    TopicList topics_;
    std::map<std::uint32_t, std::size_t> topic_of_;  ///< topic index by channel or connection
    std::uint64_t record_at_ = 0;                    ///< byte offset of the record or its chunk
    std::vector<std::uint8_t> head_, content_, chunk_;
    FieldReader in_chunk_{ByteView()};  ///< rest of the chunk, which is in the buffers above
    bool is_chunk_ = false;    ///< whether the record that begins at record_at_ is a whole chunk
    bool is_damaged_ = false;  ///< whether a damaged chunk was skipped
    std::string damage_;       ///< the first damaged chunk since takeDamage()
    std::size_t further_ = 0;  ///< damaged chunks after it
    bool is_at_end_ = false;
};

}  // namespace hagen::recordings
