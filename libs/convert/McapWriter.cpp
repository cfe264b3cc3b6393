#include "convert/McapWriter.h"
#include <zlib.h>
#include <zstd.h>
#include "base/WriteFile.h"

#include <algorithm>
#include <limits>
#include <type_traits>

namespace hagen::convert {
namespace {

using Bytes = std::vector<std::uint8_t>;

enum Op : std::uint8_t {
    kHeader = 0x01,
    kFooter = 0x02,
    kSchema = 0x03,
    kChannel = 0x04,
    kMessage = 0x05,
    kChunk = 0x06,
    kMessageIndex = 0x07,
    kChunkIndex = 0x08,
    kStatistics = 0x0b,
    kSummaryOffset = 0x0e,
    kDataEnd = 0x0f
};

constexpr std::size_t kChunkBytes = 1 << 20;  // about one scan of 16 beams
constexpr int kZstdLevel = 1;                 // fast enough to keep up with segmentation
constexpr const char* kCompression = "zstd";

Bytes magic() { return {0x89, 'M', 'C', 'A', 'P', '0', '\r', '\n'}; }

/// Appends a number, little-endian.
template <class Number>
void add(Number number, Bytes& to) {
    static_assert(std::is_unsigned_v<Number>);
    for (std::size_t i = 0; i < sizeof number; ++i) {
        to.push_back(static_cast<std::uint8_t>(number >> (8 * i)));
    }
}

void add(const std::string& text, Bytes& to) {
    add(static_cast<std::uint32_t>(text.size()), to);
    to.insert(to.end(), text.begin(), text.end());
}

void addRecord(std::uint8_t op, const Bytes& content, Bytes& to) {
    to.push_back(op);
    add(std::uint64_t{content.size()}, to);
    to.insert(to.end(), content.begin(), content.end());
}

std::uint32_t crcOf(const Bytes& bytes, std::uint32_t before = 0) {
    return static_cast<std::uint32_t>(crc32_z(before, bytes.data(), bytes.size()));
}

void packZstd(const Bytes& plain, Bytes& packed) {
    packed.resize(ZSTD_compressBound(plain.size()));
    const std::size_t size =
        ZSTD_compress(packed.data(), packed.size(), plain.data(), plain.size(), kZstdLevel);
    if (ZSTD_isError(size)) {
        throw std::runtime_error(std::string("zstd: ") + ZSTD_getErrorName(size));
    }
    packed.resize(size);
}

}  // namespace

void McapWriter::TimeSpan::add(std::uint64_t time_ns) {
    first_ns = is_empty ? time_ns : std::min(first_ns, time_ns);
    last_ns = is_empty ? time_ns : std::max(last_ns, time_ns);
    is_empty = false;
}

McapWriter::McapWriter(const std::filesystem::path& place, const std::filesystem::path& file)
    : file_(file), out_(base::openToWrite(place, file)) {
    put(magic());
    Bytes header;
    add(std::string("ros2"), header);
    add(std::string("hagen"), header);
    putRecord(kHeader, header);
}

void McapWriter::put(const Bytes& bytes) {
    out_.write(reinterpret_cast<const char*>(bytes.data()),
               static_cast<std::streamsize>(bytes.size()));
    if (!out_) base::closeWritten(out_, file_);
    position_ += bytes.size();
    crc_ = crcOf(bytes, crc_);
}

void McapWriter::putRecord(std::uint8_t op, const Bytes& content) {
    Bytes record;
    addRecord(op, content, record);
    put(record);
}

std::uint16_t McapWriter::addTopic(const std::string& name, const RosType& type) {
    if (messages_of_.size() >= std::numeric_limits<std::uint16_t>::max()) {
        throw std::runtime_error(file_.string() + ": too many topics");
    }
    const auto topic = static_cast<std::uint16_t>(messages_of_.size() + 1);
    messages_of_.push_back(0);
    // Schemas and channels must precede their messages, and are repeated in the summary.
    const auto [schema, is_new] =
        schema_of_.emplace(type.name, static_cast<std::uint16_t>(schema_of_.size() + 1));
    Bytes content;
    if (is_new) {
        add(schema->second, content);
        add(type.name, content);
        add(std::string("ros2msg"), content);
        add(type.definition, content);
        addRecord(kSchema, content, schemas_);
        addRecord(kSchema, content, chunk_);
        content.clear();
    }
    add(topic, content);
    add(schema->second, content);
    add(name, content);
    add(std::string("cdr"), content);
    add(std::uint32_t{0}, content);  // number of metadata entries
    addRecord(kChannel, content, channels_);
    addRecord(kChannel, content, chunk_);
    return topic;
}

void McapWriter::write(std::uint16_t topic, std::uint64_t time_ns, const Bytes& message) {
    std::uint64_t& sequence = messages_of_.at(topic - 1);
    in_chunk_[topic].push_back({time_ns, chunk_.size()});
    chunk_.push_back(kMessage);
    add(std::uint64_t{2 + 4 + 8 + 8 + message.size()}, chunk_);
    add(topic, chunk_);
    add(static_cast<std::uint32_t>(sequence), chunk_);
    add(time_ns, chunk_);  // recording time and publishing time
    add(time_ns, chunk_);
    chunk_.insert(chunk_.end(), message.begin(), message.end());
    ++sequence;
    ++messages_;
    chunk_times_.add(time_ns);
    times_.add(time_ns);
    if (chunk_.size() >= kChunkBytes) finishChunk();
}

void McapWriter::finishChunk() {
    if (chunk_.empty()) return;
    packZstd(chunk_, packed_);
    Bytes head;
    add(chunk_times_.first_ns, head);
    add(chunk_times_.last_ns, head);
    add(std::uint64_t{chunk_.size()}, head);
    add(crcOf(chunk_), head);
    add(std::string(kCompression), head);
    add(std::uint64_t{packed_.size()}, head);
    head.insert(head.end(), packed_.begin(), packed_.end());

    ChunkIndex index{};
    index.times = chunk_times_;
    index.at = position_;
    index.plain_size = chunk_.size();
    index.packed_size = packed_.size();
    putRecord(kChunk, head);
    index.size = position_ - index.at;
    for (const auto& [topic, messages] : in_chunk_) {
        index.index_at[topic] = position_;
        Bytes content;
        add(topic, content);
        add(static_cast<std::uint32_t>(16 * messages.size()), content);
        for (const Placed& message : messages) {
            add(message.time_ns, content);
            add(message.offset, content);
        }
        putRecord(kMessageIndex, content);
    }
    index.indices_size = position_ - index.at - index.size;
    chunks_.push_back(index);
    chunk_.clear();
    in_chunk_.clear();
    chunk_times_ = {};
}

/// Writes the summary: groups of records, then the offset of each group.
void McapWriter::putSummary() {
    Bytes statistics;
    add(std::uint64_t{messages_}, statistics);
    add(static_cast<std::uint16_t>(schema_of_.size()), statistics);
    add(static_cast<std::uint32_t>(messages_of_.size()), statistics);
    add(std::uint32_t{0}, statistics);  // number of attachments
    add(std::uint32_t{0}, statistics);  // number of metadata records
    add(static_cast<std::uint32_t>(chunks_.size()), statistics);
    add(times_.first_ns, statistics);
    add(times_.last_ns, statistics);
    add(static_cast<std::uint32_t>(10 * messages_of_.size()), statistics);
    for (std::size_t i = 0; i < messages_of_.size(); ++i) {
        add(static_cast<std::uint16_t>(i + 1), statistics);
        add(messages_of_[i], statistics);
    }
    Bytes statistics_record, chunk_indices;
    addRecord(kStatistics, statistics, statistics_record);
    for (const ChunkIndex& chunk : chunks_) {
        Bytes content;
        add(chunk.times.first_ns, content);
        add(chunk.times.last_ns, content);
        add(chunk.at, content);
        add(chunk.size, content);
        add(static_cast<std::uint32_t>(10 * chunk.index_at.size()), content);
        for (const auto& [topic, at] : chunk.index_at) {
            add(topic, content);
            add(at, content);
        }
        add(chunk.indices_size, content);
        add(std::string(kCompression), content);
        add(chunk.packed_size, content);
        add(chunk.plain_size, content);
        addRecord(kChunkIndex, content, chunk_indices);
    }

    const std::uint64_t summary_at = position_;
    Bytes offsets;
    const auto putGroup = [&](std::uint8_t op, const Bytes& records) {
        if (records.empty()) return;
        Bytes content{op};
        add(position_, content);
        add(std::uint64_t{records.size()}, content);
        addRecord(kSummaryOffset, content, offsets);
        put(records);
    };
    putGroup(kSchema, schemas_);
    putGroup(kChannel, channels_);
    putGroup(kStatistics, statistics_record);
    putGroup(kChunkIndex, chunk_indices);
    const std::uint64_t offsets_at = position_;
    put(offsets);

    Bytes footer{kFooter};
    add(std::uint64_t{8 + 8 + 4}, footer);
    add(summary_at, footer);
    add(offsets_at, footer);
    put(footer);
    Bytes end;
    add(crc_, end);  // CRC of the summary and of the footer up to here
    put(end);
}

void McapWriter::close() {
    finishChunk();
    Bytes crc;
    add(crc_, crc);
    putRecord(kDataEnd, crc);
    crc_ = 0;
    putSummary();
    put(magic());
    base::closeWritten(out_, file_);
}

}  // namespace hagen::convert
