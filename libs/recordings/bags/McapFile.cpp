#include <zlib.h>

#include <string_view>

#include "recordings/bags/BagFormats.h"
#include "recordings/bags/RecordFile.h"
#include "recordings/bags/Unpack.h"

namespace hagen::recordings {
namespace {

constexpr std::string_view kMcapMagic{"\x89MCAP0\r\n", 8};
constexpr std::uint64_t kMaxFooter = 1 << 16;  // currently 20 bytes; later versions may add fields
enum McapOp : std::uint8_t {
    kMcapFooter = 0x02,
    kMcapSchema = 0x03,
    kMcapChannel = 0x04,
    kMcapMessage = 0x05,
    kMcapChunk = 0x06,
    kMcapDataEnd = 0x0f
};

std::string mcapRecordName(std::uint8_t op) {
    static const std::map<std::uint8_t, const char*> kNames{
        {kMcapFooter, "the footer"}, {kMcapSchema, "a schema"},
        {kMcapChannel, "a channel"}, {kMcapMessage, "a message"},
        {kMcapChunk, "a chunk"},     {kMcapDataEnd, "the end of the data"}};
    const auto name = kNames.find(op);
    return name == kNames.end() ? "a record (" + std::to_string(op) + ")" : name->second;
}

void checkCrc(std::uint32_t due, std::uint32_t found, const std::string& of) {
    if (due == 0 || due == found) return;  // 0: CRC not computed
    throw std::runtime_error("the CRC of " + of + " is wrong: the file was changed or damaged");
}

class McapFile : public RecordFile {
 public:
    explicit McapFile(const std::filesystem::path& file) : RecordFile(file, true) {
        file_.read(kMcapMagic.size(), "the magic bytes", head_);
    }

 private:
    bool readRecord(BagMessage& message) override {
        const std::uint32_t crc_before = file_.crc();
        file_.read(9, "a record header", head_);
        FieldReader head({head_.data(), head_.size()});
        const auto op = head.number<std::uint8_t>();
        const auto size = head.number<std::uint64_t>();
        if (op == 0) failKind();
        if (op == kMcapFooter) return readFooter(size);
        if (is_data_ended_ && (op == kMcapMessage || op == kMcapChunk)) {
            throw std::runtime_error(mcapRecordName(op) + " follows the end of the data");
        }
        const bool is_read = op >= kMcapSchema && op <= kMcapChunk;
        if (is_data_ended_ || (!is_read && op != kMcapDataEnd)) {
            file_.beginSkip(size, mcapRecordName(op));
            return false;
        }
        if (size > kMaxUnpackedBytes) {
            throw std::runtime_error(mcapRecordName(op) + " claims " + std::to_string(size) +
                                     " bytes");
        }
        file_.read(size, mcapRecordName(op), content_);
        const ByteView content{content_.data(), content_.size()};
        is_chunk_ = op == kMcapChunk;
        if (op != kMcapDataEnd) return takeRecord(op, content, message);
        const auto due = FieldReader(content).number<std::uint32_t>();
        if (!is_damaged_) checkCrc(due, crc_before, "the data before it");
        is_data_ended_ = true;
        summary_at_ = file_.position();
        file_.restartCrc();
        return false;
    }

    bool readInChunk(BagMessage& message) override {
        const auto op = in_chunk_.number<std::uint8_t>();
        if (op == 0) failKind();
        if (op == kMcapChunk) throw std::runtime_error("it contains another chunk");
        const auto size = in_chunk_.number<std::uint64_t>();
        if (size > in_chunk_.left()) {
            throw TooShort(mcapRecordName(op) + " in it claims " + std::to_string(size) +
                           " bytes, but only " + std::to_string(in_chunk_.left()) + " are left");
        }
        return takeRecord(op, in_chunk_.take(static_cast<std::size_t>(size)), message);
    }

    [[noreturn]] static void failKind() {
        throw std::runtime_error("it contains a record of the invalid type 0");
    }

    bool takeRecord(std::uint8_t op, ByteView content, BagMessage& message) {
        FieldReader fields(content);
        try {
            if (op == kMcapSchema) {
                const auto id = fields.number<std::uint16_t>();
                schemas_[id] = fields.text();
            } else if (op == kMcapChannel) {
                takeChannel(fields);
            } else if (op == kMcapChunk) {
                takeChunk(fields);
            } else if (op == kMcapMessage) {
                const auto channel = fields.number<std::uint16_t>();
                fields.take(4);  // sequence number
                const auto time_ns = static_cast<std::int64_t>(fields.number<std::uint64_t>());
                fields.take(8);  // publication time
                return take("channel", channel, time_ns, fields.take(fields.left()), message);
            }
        } catch (const TooShort& e) {
            throw std::runtime_error(mcapRecordName(op) + " is too short: " + e.what());
        }
        return false;
    }

    void takeChunk(FieldReader fields) {
        fields.take(16);  // times
        const auto size = fields.number<std::uint64_t>();
        const auto crc = fields.number<std::uint32_t>();
        const std::string compression = fields.text();
        const auto packed_size = fields.number<std::uint64_t>();
        if (packed_size > fields.left()) throw TooShort("its records are truncated");
        const ByteView records =
            unpack(compression, fields.take(static_cast<std::size_t>(packed_size)), size, chunk_);
        if (crc != 0) {
            checkCrc(crc, static_cast<std::uint32_t>(crc32_z(0, records.data, records.size)),
                     "the chunk");
        }
        in_chunk_ = FieldReader(records);
    }

    void takeChannel(FieldReader fields) {
        const auto id = fields.number<std::uint16_t>();
        const auto schema = schemas_.find(fields.number<std::uint16_t>());
        BagTopic topic;
        topic.name = fields.text();
        topic.encoding = fields.text();
        if (topic.encoding == "ros1msg") topic.encoding = "ros1";
        if (schema != schemas_.end()) topic.type = typeAsInRos1(schema->second);
        topic_of_[id] = topics_.indexOf(topic);
    }

    bool readFooter(std::uint64_t size) {
        if (size < 20) throw TooShort("the footer is too short");
        if (size > kMaxFooter) {
            throw std::runtime_error("the footer claims " + std::to_string(size) + " bytes");
        }
        if (!is_data_ended_) {
            throw std::runtime_error("the footer precedes the end of the data");
        }
        file_.read(16, "the footer", content_);
        const std::uint32_t crc = file_.crc();
        const auto summary_at = FieldReader({content_.data(), 8}).number<std::uint64_t>();
        file_.read(4, "the footer", content_);
        const auto due = FieldReader({content_.data(), 4}).number<std::uint32_t>();
        // Without a summary, this CRC starts with the footer and does not cover messages.
        if (summary_at == summary_at_) checkCrc(due, crc, "the summary");
        file_.read(size - 20, "the footer", content_);
        file_.read(kMcapMagic.size(), "the magic bytes at the end", content_);
        if (std::string(content_.begin(), content_.end()) != kMcapMagic) {
            throw std::runtime_error("the magic bytes at the end are missing");
        }
        if (file_.left() > 0) {
            throw std::runtime_error("data after the end of the recording (" +
                                     std::to_string(file_.left()) +
                                     " B); was another file appended?");
        }
        is_at_end_ = true;
        return false;
    }

    std::map<std::uint16_t, std::string> schemas_;
    bool is_data_ended_ = false;
    std::uint64_t summary_at_ = 0;
};

}  // namespace

bool isMcap(const std::string& start) {
    return start.compare(0, kMcapMagic.size(), kMcapMagic) == 0;
}

std::unique_ptr<BagFile> openMcap(const std::filesystem::path& file) {
    return std::make_unique<McapFile>(file);
}

}  // namespace hagen::recordings
