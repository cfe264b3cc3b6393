#pragma once
#include "convert/RosMessages.h"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <map>
#include <string>
#include <vector>

namespace hagen::convert {

/// Writes an MCAP file (https://mcap.dev/spec) of the profile "ros2". Messages are in zstd chunks,
/// each with an index; the summary at the end repeats schemas and channels and indexes the chunks,
/// so that readers can seek. Chunks, the data and the summary have CRCs. The same messages produce
/// the same bytes.
class McapWriter {
 public:
    /// Writes to `place`; errors name `file`. Throws std::runtime_error if it cannot be opened.
    McapWriter(const std::filesystem::path& place, const std::filesystem::path& file);

    /// Adds a topic for messages in CDR, and returns its number. Throws std::runtime_error if there
    /// are more than 65535 topics.
    std::uint16_t addTopic(const std::string& name, const RosType& type);

    /// Writes a message of a topic; times are since 1970. A full disk may be reported after further
    /// messages, or only by close().
    void write(std::uint16_t topic, std::uint64_t time_ns,
               const std::vector<std::uint8_t>& message);

    /// Completes the file. Throws std::runtime_error naming the file if writing failed.
    void close();

    std::size_t messages() const { return messages_; }

 private:
    using Bytes = std::vector<std::uint8_t>;
    struct TimeSpan {
        std::uint64_t first_ns = 0, last_ns = 0;
        bool is_empty = true;
        void add(std::uint64_t time_ns);
    };
    struct Placed {
        std::uint64_t time_ns, offset;
    };
    struct ChunkIndex {
        TimeSpan times;
        std::uint64_t at, size, packed_size, plain_size, indices_size;
        std::map<std::uint16_t, std::uint64_t> index_at;  ///< offset of the message index, by topic
    };

    void put(const Bytes& bytes);
    void putRecord(std::uint8_t op, const Bytes& content);
    void finishChunk();
    void putSummary();

    std::filesystem::path file_;
    std::ofstream out_;
    std::uint64_t position_ = 0;
    std::uint32_t crc_ = 0;  ///< CRC of the section

    Bytes schemas_, channels_;                        ///< serialised records
    std::map<std::string, std::uint16_t> schema_of_;  ///< schema number by type
    std::vector<std::uint64_t> messages_of_;          ///< number of messages by topic
    Bytes chunk_, packed_;
    TimeSpan chunk_times_, times_;
    std::map<std::uint16_t, std::vector<Placed>> in_chunk_;  ///< messages by topic
    std::vector<ChunkIndex> chunks_;
    std::size_t messages_ = 0;
};

}  // namespace hagen::convert
