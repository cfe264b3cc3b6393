#include "recordings/bags/McapFile.h"

#include <zlib.h>

#include <string_view>

#include "recordings/bags/Unpack.h"

namespace hagen::recordings {
namespace {

constexpr std::string_view kMagic{"\x89MCAP0\r\n", 8};
constexpr std::uint64_t kMostFooter = 1 << 16;  // it has 20 bytes; later versions may add some
enum Op : std::uint8_t {
    kFooter = 0x02,
    kSchema = 0x03,
    kChannel = 0x04,
    kMessage = 0x05,
    kChunk = 0x06,
    kDataEnd = 0x0f
};

std::string nameOf(std::uint8_t op) {
    switch (op) {
        case kFooter:
            return "the footer";
        case kSchema:
            return "a schema";
        case kChannel:
            return "a channel";
        case kMessage:
            return "a message";
        case kChunk:
            return "a chunk";
        case kDataEnd:
            return "the end of the data";
        default:
            return "a record (" + std::to_string(op) + ")";
    }
}

bool isRead(std::uint8_t op) {
    return op == kSchema || op == kChannel || op == kMessage || op == kChunk || op == kDataEnd;
}

void checkKind(std::uint8_t op) {
    if (op == 0) throw std::runtime_error("its kind is 0, which there is not");
}

void checkCrc(std::uint32_t due, std::uint32_t found, const std::string& of) {
    if (due == 0 || due == found) return;  // 0: there is none
    throw std::runtime_error("the CRC of " + of + " is wrong: the file was changed or damaged");
}

/// "cdr", "ros1": how the messages of a channel are serialised.
std::string encodingOf(const std::string& message_encoding) {
    return message_encoding == "ros1msg" ? "ros1" : message_encoding;
}

}  // namespace

bool McapFile::isOne(const std::string& start) {
    return start.compare(0, kMagic.size(), kMagic) == 0;
}

McapFile::McapFile(const std::filesystem::path& file) : file_(file, true) {
    file_.read(kMagic.size(), "the format's name", head_);
}

bool McapFile::next(BagMessage& message) {
    while (!is_at_end_) {
        check();
        const bool is_in_chunk = in_chunk_.left() > 0;
        try {
            if (file_.isSkipping()) {
                file_.skipSome();
                continue;
            }
            if (is_in_chunk) {
                if (readInChunk(message)) return true;
                continue;
            }
            record_at_ = file_.position();
            if (readRecord(message)) return true;
        } catch (const BrokenBag&) {
            throw;
        } catch (const std::runtime_error& e) {
            in_chunk_ = FieldReader(ByteView());
            file_.fail(is_in_chunk ? "the chunk" : "a record", record_at_, e.what());
        }
    }
    return false;
}

/// Reads a record of the file; true if it is a message.
bool McapFile::readRecord(BagMessage& message) {
    const std::uint32_t crc_before = file_.crc();
    file_.read(9, "the head of a record", head_);
    FieldReader head({head_.data(), head_.size()});
    const auto op = head.number<std::uint8_t>();
    const auto size = head.number<std::uint64_t>();
    if (op == kFooter) {
        readFooter(size);
        return false;
    }
    checkKind(op);
    if (is_data_ended_ && (op == kMessage || op == kChunk)) {
        throw std::runtime_error(nameOf(op) + " comes after the end of the data");
    }
    if (is_data_ended_ || !isRead(op)) {
        file_.beginSkip(size, nameOf(op));
        return false;
    }
    if (size > kMostUnpacked) {
        throw std::runtime_error(nameOf(op) + " claims " + std::to_string(size) + " bytes");
    }
    file_.read(size, nameOf(op), content_);
    const ByteView content{content_.data(), content_.size()};
    if (op == kDataEnd) {
        checkDataCrc(FieldReader(content), crc_before);
        return false;
    }
    return takeRecord(op, content, message);
}

bool McapFile::readInChunk(BagMessage& message) {
    const auto op = in_chunk_.number<std::uint8_t>();
    checkKind(op);
    if (op == kChunk) throw std::runtime_error("a chunk is within it");
    const auto size = in_chunk_.number<std::uint64_t>();
    if (size > in_chunk_.left()) {
        throw TooShort(nameOf(op) + " in it claims " + std::to_string(size) + " bytes, " +
                       std::to_string(in_chunk_.left()) + " are left");
    }
    const ByteView content = in_chunk_.take(static_cast<std::size_t>(size));
    return takeRecord(op, content, message);
}

bool McapFile::takeRecord(std::uint8_t op, ByteView content, BagMessage& message) {
    FieldReader fields(content);
    try {
        if (op == kSchema) {
            const auto id = fields.number<std::uint16_t>();
            schemas_[id] = fields.text();
        } else if (op == kChannel) {
            takeChannel(fields);
        } else if (op == kChunk) {
            takeChunk(fields);
        } else if (op == kMessage) {
            return takeMessage(fields, message);
        }
    } catch (const TooShort& e) {
        throw std::runtime_error(nameOf(op) + " is too short: " + e.what());
    }
    return false;
}

void McapFile::takeChunk(FieldReader fields) {
    fields.take(16);  // its times
    const auto size = fields.number<std::uint64_t>();
    const auto crc = fields.number<std::uint32_t>();
    const std::string compression = fields.text();
    const auto packed_size = fields.number<std::uint64_t>();
    if (packed_size > fields.left()) throw TooShort("its records are cut off");
    const ByteView records =
        unpack(compression, fields.take(static_cast<std::size_t>(packed_size)), size, chunk_);
    if (crc != 0) {
        checkCrc(crc, static_cast<std::uint32_t>(crc32_z(0, records.data, records.size)),
                 "the chunk");
    }
    in_chunk_ = FieldReader(records);
}

void McapFile::takeChannel(FieldReader fields) {
    const auto id = fields.number<std::uint16_t>();
    const auto schema = fields.number<std::uint16_t>();
    BagTopic topic;
    topic.name = fields.text();
    topic.encoding = encodingOf(fields.text());
    const auto known = schemas_.find(schema);
    if (known != schemas_.end()) topic.type = typeAsInRos1(known->second);
    topic_of_[id] = topics_.indexOf(topic);
}

bool McapFile::takeMessage(FieldReader fields, BagMessage& message) const {
    const auto channel = fields.number<std::uint16_t>();
    const auto topic = topic_of_.find(channel);
    if (topic == topic_of_.end()) {
        throw std::runtime_error("a message is of channel " + std::to_string(channel) +
                                 ", which is not described before it");
    }
    fields.take(4);  // sequence number
    message.topic = topic->second;
    message.time_ns = static_cast<std::int64_t>(fields.number<std::uint64_t>());
    fields.take(8);  // when it was published
    const ByteView data = fields.take(fields.left());
    message.bytes = data.data;
    message.size = data.size;
    return true;
}

void McapFile::checkDataCrc(FieldReader fields, std::uint32_t crc) {
    checkCrc(fields.number<std::uint32_t>(), crc, "the data before it");
    is_data_ended_ = true;
    summary_at_ = file_.position();
    file_.restartCrc();
}

void McapFile::readFooter(std::uint64_t size) {
    if (size < 20) throw TooShort("the footer is too short");
    if (size > kMostFooter) {
        throw std::runtime_error("the footer claims " + std::to_string(size) + " bytes");
    }
    if (!is_data_ended_) throw std::runtime_error("the footer comes before the end of the data");
    file_.read(16, "the footer", content_);
    const std::uint32_t crc = file_.crc();
    const auto summary_at = FieldReader({content_.data(), 8}).number<std::uint64_t>();
    file_.read(4, "the footer", content_);
    const auto due = FieldReader({content_.data(), 4}).number<std::uint32_t>();
    // Without a summary, the CRC begins with the footer; it then says nothing of the messages.
    if (summary_at == summary_at_) checkCrc(due, crc, "the summary");
    file_.read(size - 20, "the footer", content_);
    file_.read(kMagic.size(), "the format's name at the end", content_);
    if (std::string(content_.begin(), content_.end()) != kMagic) {
        throw std::runtime_error("the format's name is missing at the end");
    }
    if (file_.left() > 0) {
        throw std::runtime_error("the file goes on for " + std::to_string(file_.left()) +
                                 " bytes after its end; was another one appended?");
    }
    is_at_end_ = true;
}

}  // namespace hagen::recordings
