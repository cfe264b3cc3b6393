#include "recordings/bags/Ros1Bag.h"

#include <string_view>

#include "recordings/bags/Unpack.h"

namespace hagen::recordings {
namespace {

constexpr std::string_view kMagic = "#ROSBAG V2.0\n";
constexpr std::uint64_t kMostHeader = 1 << 20;
enum Op : std::uint8_t {
    kMessage = 0x02,
    kBagHeader = 0x03,
    kIndex = 0x04,
    kChunk = 0x05,
    kChunkInfo = 0x06,
    kConnection = 0x07
};

/// "name=value" fields, each after its size.
std::map<std::string, std::string> fieldsOf(ByteView header) {
    std::map<std::string, std::string> fields;
    FieldReader reader(header);
    while (reader.left() > 0) {
        const std::string field = reader.text();
        const std::size_t equals = field.find('=');
        if (equals == std::string::npos)
            throw std::runtime_error("a field of its header has no '='");
        fields[field.substr(0, equals)] = field.substr(equals + 1);
    }
    return fields;
}

const std::string& at(const std::map<std::string, std::string>& fields, const std::string& name) {
    const auto found = fields.find(name);
    if (found == fields.end()) throw std::runtime_error("its header has no '" + name + "'");
    return found->second;
}

template <class Number>
Number numberAt(const std::map<std::string, std::string>& fields, const std::string& name) {
    const std::string& value = at(fields, name);
    if (value.size() != sizeof(Number)) {
        throw std::runtime_error("'" + name + "' in its header has " +
                                 std::to_string(value.size()) + " bytes, not " +
                                 std::to_string(sizeof(Number)));
    }
    return FieldReader({reinterpret_cast<const std::uint8_t*>(value.data()), value.size()})
        .number<Number>();
}

std::string nameOf(std::uint8_t op) {
    switch (op) {
        case kMessage:
            return "a message";
        case kBagHeader:
            return "the bag's header";
        case kIndex:
            return "an index";
        case kChunk:
            return "a chunk";
        case kChunkInfo:
            return "the description of a chunk";
        case kConnection:
            return "a connection";
        default:
            return "a record";
    }
}

std::uint64_t little32(const std::vector<std::uint8_t>& bytes) {
    return FieldReader({bytes.data(), bytes.size()}).number<std::uint32_t>();
}

}  // namespace

bool Ros1Bag::isOne(const std::string& start) { return start.rfind("#ROSBAG V", 0) == 0; }

Ros1Bag::Ros1Bag(const std::filesystem::path& file) : file_(file) {
    file_.read(kMagic.size(), "the format's name", header_);
    const std::string magic(header_.begin(), header_.end());
    if (magic != kMagic) {
        file_.fail("the format's name", 0,
                   "is '" + magic.substr(0, magic.find('\n')) +
                       "'; only format 2.0 can be read: migrate it by 'rosbag fix'");
    }
}

bool Ros1Bag::next(BagMessage& message) {
    std::string what = "a record";
    while (true) {
        check();
        try {
            if (file_.isSkipping()) {
                file_.skipSome();
                continue;
            }
            if (in_chunk_.left() > 0) {
                if (readInChunk(message)) return true;
                continue;
            }
            record_at_ = file_.position();
            if (file_.left() == 0) {
                checkEnd();
                return false;
            }
            if (readRecord(message)) return true;
        } catch (const BrokenBag&) {
            throw;
        } catch (const std::runtime_error& e) {
            const bool is_in_chunk = in_chunk_.left() > 0;
            in_chunk_ = FieldReader(ByteView());
            file_.fail(is_in_chunk ? "the chunk" : what, record_at_, e.what());
        }
    }
}

/// Reads a record of the file; true if it is a message.
bool Ros1Bag::readRecord(BagMessage& message) {
    file_.read(4, "the size of a record", header_);
    const std::uint64_t header_size = little32(header_);
    if (header_size > kMostHeader) {
        throw std::runtime_error("its header claims " + std::to_string(header_size) + " bytes");
    }
    file_.read(header_size, "the header of a record", header_);
    const Fields fields = fieldsOf({header_.data(), header_.size()});
    const auto op = numberAt<std::uint8_t>(fields, "op");
    file_.read(4, "the size of " + nameOf(op), data_);
    const std::uint64_t size = little32(data_);
    const bool is_read = op == kChunk || op == kConnection || op == kMessage;
    if (is_read) {
        if (size > kMostUnpacked) {
            throw std::runtime_error("it claims " + std::to_string(size) + " bytes");
        }
        file_.read(size, nameOf(op), data_);
    } else {
        file_.beginSkip(size, nameOf(op));
    }
    const ByteView data{data_.data(), is_read ? data_.size() : 0};
    if (op == kBagHeader) readBagHeader(fields);
    if (op == kChunk) readChunk(fields);
    if (op == kConnection) takeConnection(fields, data);
    chunk_infos_ += op == kChunkInfo;
    return op == kMessage && takeMessage(fields, data, message);
}

void Ros1Bag::readBagHeader(const Fields& fields) {
    const auto encryptor = fields.find("encryptor");
    if (encryptor != fields.end() && !encryptor->second.empty()) {
        throw std::runtime_error("the bag is encrypted (" + encryptor->second.substr(0, 64) +
                                 "); decrypt it by 'rosbag decrypt'");
    }
    has_header_ = true;
    index_at_ = numberAt<std::uint64_t>(fields, "index_pos");
    chunks_due_ = numberAt<std::uint32_t>(fields, "chunk_count");
}

void Ros1Bag::readChunk(const Fields& fields) {
    ++chunks_;
    in_chunk_ = FieldReader(unpack(at(fields, "compression"), {data_.data(), data_.size()},
                                   numberAt<std::uint32_t>(fields, "size"), chunk_));
}

/// Reads a record of the chunk; true if it is a message.
bool Ros1Bag::readInChunk(BagMessage& message) {
    const Fields fields = fieldsOf(in_chunk_.take(in_chunk_.count(1)));
    const ByteView data = in_chunk_.take(in_chunk_.count(1));
    const auto op = numberAt<std::uint8_t>(fields, "op");
    if (op == kConnection) takeConnection(fields, data);
    return op == kMessage && takeMessage(fields, data, message);
}

void Ros1Bag::takeConnection(const Fields& fields, ByteView data) {
    const Fields more = fieldsOf(data);
    topic_of_[numberAt<std::uint32_t>(fields, "conn")] =
        topics_.indexOf({at(fields, "topic"), typeAsInRos1(at(more, "type")), "ros1"});
}

bool Ros1Bag::takeMessage(const Fields& fields, ByteView data, BagMessage& message) const {
    const auto connection = numberAt<std::uint32_t>(fields, "conn");
    const auto topic = topic_of_.find(connection);
    if (topic == topic_of_.end()) {
        throw std::runtime_error("a message is of connection " + std::to_string(connection) +
                                 ", which is not described before it");
    }
    const auto time = numberAt<std::uint64_t>(fields, "time");  // seconds, then nanoseconds
    message.topic = topic->second;
    message.time_ns = static_cast<std::int64_t>(time & 0xffffffff) * 1000000000 +
                      static_cast<std::int64_t>(time >> 32);
    message.bytes = data.data;
    message.size = data.size;
    return true;
}

/// Throws unless the bag was closed.
void Ros1Bag::checkEnd() const {
    if (!has_header_) throw std::runtime_error("there is no bag header: the bag is cut off");
    if (index_at_ == 0) {
        throw std::runtime_error("the bag ends here without an index: it was not closed");
    }
    if (chunks_ != chunks_due_ || chunk_infos_ != chunks_due_) {
        throw std::runtime_error("the bag ends here with " + std::to_string(chunks_) + " chunks, " +
                                 std::to_string(chunk_infos_) + " of them described; its header " +
                                 "says " + std::to_string(chunks_due_));
    }
}

}  // namespace hagen::recordings
