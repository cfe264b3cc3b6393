#include <string_view>

#include "recordings/bags/BagFormats.h"
#include "recordings/bags/RecordFile.h"
#include "recordings/bags/Unpack.h"

namespace hagen::recordings {
namespace {

constexpr std::string_view kRos1Magic = "#ROSBAG V2.0\n";
constexpr std::uint64_t kMaxRecordHeader = 1 << 20;
enum Ros1Op : std::uint8_t {
    kRos1Message = 0x02,
    kRos1BagHeader = 0x03,
    kRos1Chunk = 0x05,
    kRos1Connection = 0x07
};

/// The "name=value" fields in a record's header. Each field starts with its size.
class RecordHeader {
 public:
    explicit RecordHeader(ByteView header) {
        for (FieldReader reader(header); reader.left() > 0;) {
            const std::string field = reader.text();
            const std::size_t equals = field.find('=');
            if (equals == std::string::npos) {
                throw std::runtime_error("a header field has no '='");
            }
            fields_[field.substr(0, equals)] = field.substr(equals + 1);
        }
    }

    bool has(const std::string& name) const { return fields_.count(name) > 0; }
    const std::string& at(const std::string& name) const {
        const auto found = fields_.find(name);
        if (found == fields_.end()) throw std::runtime_error("its header has no '" + name + "'");
        return found->second;
    }
    template <class Number>
    Number number(const std::string& name) const {
        const std::string& value = at(name);
        if (value.size() != sizeof(Number)) {
            throw std::runtime_error("'" + name + "' in its header has " +
                                     base::counted(value.size(), "byte") + ", not " +
                                     std::to_string(sizeof(Number)));
        }
        return FieldReader({reinterpret_cast<const std::uint8_t*>(value.data()), value.size()})
            .number<Number>();
    }
    std::uint8_t op() const { return number<std::uint8_t>("op"); }

 private:
    std::map<std::string, std::string> fields_;
};

class Ros1Bag : public RecordFile {
 public:
    explicit Ros1Bag(const std::filesystem::path& file) : RecordFile(file, false) {
        file_.read(kRos1Magic.size(), "the format line", head_);
        const std::string magic(head_.begin(), head_.end());
        if (magic == kRos1Magic) return;
        file_.fail("the format line", 0,
                   "is '" + magic.substr(0, magic.find('\n')) +
                       "'; only format 2.0 is supported: migrate the bag with 'rosbag fix'");
    }

 private:
    bool readRecord(BagMessage& message) override {
        if (file_.left() == 0) {
            checkEnd();
            is_at_end_ = true;
            return false;
        }
        const std::uint64_t header_size = readSize("the size of a record", head_);
        if (header_size > kMaxRecordHeader) {
            throw std::runtime_error("its header claims " + std::to_string(header_size) + " bytes");
        }
        file_.read(header_size, "the header of a record", head_);
        const RecordHeader header({head_.data(), head_.size()});
        const std::uint8_t op = header.op();
        const std::uint64_t size = readSize("the size of a record", content_);
        if (op != kRos1Chunk && op != kRos1Connection && op != kRos1Message) {
            file_.beginSkip(size, "a record");
            if (op == kRos1BagHeader) takeBagHeader(header);
            return false;
        }
        if (size > kMaxUnpackedBytes) {
            throw std::runtime_error("it claims " + std::to_string(size) + " bytes");
        }
        file_.read(size, "a record", content_);
        const ByteView data{content_.data(), content_.size()};
        if (op != kRos1Chunk) return takeRecord(header, data, message);
        is_chunk_ = true;
        in_chunk_ = FieldReader(
            unpack(header.at("compression"), data, header.number<std::uint32_t>("size"), chunk_));
        return false;
    }

    bool readInChunk(BagMessage& message) override {
        const RecordHeader header(in_chunk_.take(in_chunk_.count(1)));
        return takeRecord(header, in_chunk_.take(in_chunk_.count(1)), message);
    }

    std::uint64_t readSize(const std::string& what, std::vector<std::uint8_t>& buffer) {
        file_.read(4, what, buffer);
        return FieldReader({buffer.data(), buffer.size()}).number<std::uint32_t>();
    }

    void takeBagHeader(const RecordHeader& header) {
        if (header.has("encryptor") && !header.at("encryptor").empty()) {
            throw std::runtime_error("the bag is encrypted (" +
                                     header.at("encryptor").substr(0, 64) +
                                     "); decrypt it with 'rosbag decrypt'");
        }
        has_header_ = true;
        index_at_ = header.number<std::uint64_t>("index_pos");
    }

    /// Reads a connection or a message. Returns true if it is a message.
    bool takeRecord(const RecordHeader& header, ByteView data, BagMessage& message) {
        const std::uint8_t op = header.op();
        if (op == kRos1Connection) {
            const RecordHeader more(data);
            topic_of_[header.number<std::uint32_t>("conn")] =
                topics_.indexOf({header.at("topic"), typeAsInRos1(more.at("type")), "ros1"});
        }
        if (op != kRos1Message) return false;
        const auto connection = header.number<std::uint32_t>("conn");
        const auto time = header.number<std::uint64_t>("time");  // seconds and nanoseconds
        const std::int64_t time_ns = static_cast<std::int64_t>(time & 0xffffffff) * 1000000000 +
                                     static_cast<std::int64_t>(time >> 32);
        return take("connection", connection, time_ns, data, message);
    }

    /// Throws std::runtime_error if the bag was not closed.
    void checkEnd() const {
        if (!has_header_) {
            throw std::runtime_error("there is no bag header: the bag is truncated");
        }
        if (index_at_ == 0) {
            throw std::runtime_error("the bag ends here without an index: it was not closed");
        }
    }

    bool has_header_ = false;
    std::uint64_t index_at_ = 0;
};

}  // namespace

bool isRos1Bag(const std::string& start) { return start.rfind("#ROSBAG V", 0) == 0; }

std::unique_ptr<BagFile> openRos1Bag(const std::filesystem::path& file) {
    return std::make_unique<Ros1Bag>(file);
}

}  // namespace hagen::recordings
