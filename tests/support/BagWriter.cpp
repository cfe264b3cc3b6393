#include "support/BagWriter.h"

#include <bzlib.h>
#include <lz4frame.h>
#include <sqlite3.h>
#include <zlib.h>
#include <zstd.h>

#include <cmath>
#include <map>
#include <stdexcept>

#include "support/RawBytes.h"

namespace hagen::test {
namespace {

std::uint64_t nanoseconds(double time_s) {
    return static_cast<std::uint64_t>(std::llround(1e6 * time_s)) * 1000;
}

std::uint32_t crcOf(const ByteString& bytes) {
    return static_cast<std::uint32_t>(
        crc32(0, reinterpret_cast<const Bytef*>(bytes.data()), static_cast<uInt>(bytes.size())));
}

ByteString mcapText(const std::string& text) {
    return raw(static_cast<std::uint32_t>(text.size())) + text;
}

/// Converts a type name to the form "sensor_msgs/msg/PointCloud2".
std::string typeOfRos2(const std::string& type) {
    const std::size_t slash = type.find('/');
    return type.substr(0, slash) + "/msg" + type.substr(slash);
}

/// Assigns numbers to topics in their order, from 1.
std::map<std::string, std::uint16_t> numbersOf(const std::vector<SentMessage>& messages) {
    std::map<std::string, std::uint16_t> numbers;
    for (const SentMessage& message : messages) {
        const auto next = static_cast<std::uint16_t>(numbers.size() + 1);
        numbers.emplace(message.topic + " " + message.type, next);
    }
    return numbers;
}

}  // namespace

MessageBytes& MessageBytes::time(double time_s) {
    const std::uint64_t ns = nanoseconds(time_s);
    return number(static_cast<std::uint32_t>(ns / 1000000000))
        .number(static_cast<std::uint32_t>(ns % 1000000000));
}

MessageBytes& MessageBytes::header(double time_s, const std::string& frame) {
    if (!is_cdr_) number(std::uint32_t{7});  // sequence number
    return time(time_s).text(frame);
}

MessageBytes& MessageBytes::pose(double x, double y, double z, double yaw_rad) {
    for (const double value : {x, y, z, 0.0, 0.0, std::sin(yaw_rad / 2), std::cos(yaw_rad / 2)}) {
        number(value);
    }
    return *this;
}

SentMessage cloudMessage(const std::string& topic, double time_s, const std::string& frame,
                         const std::vector<float>& xyzi) {
    return sentMessage(topic, "sensor_msgs/PointCloud2", time_s, [&](MessageBytes& bytes) {
        const auto points = static_cast<std::uint32_t>(xyzi.size() / 4);
        bytes.header(time_s, frame).number(std::uint32_t{1}).number(points);
        bytes.number(std::uint32_t{4});
        std::uint32_t offset = 0;
        for (const char* name : {"x", "y", "z", "intensity"}) {
            bytes.text(name).number(offset).number(std::uint8_t{7}).number(std::uint32_t{1});
            offset += 4;
        }
        bytes.number(std::uint8_t{0}).number(std::uint32_t{16}).number(16 * points);
        bytes.counted(raw(xyzi));
        bytes.number(std::uint8_t{1});
    });
}

SentMessage velodyneMessage(const std::string& topic, double time_s, const std::string& frame,
                            const mrpt::obs::CObservationVelodyneScan& scan, double period_s) {
    return sentMessage(topic, "velodyne_msgs/VelodyneScan", time_s, [&](MessageBytes& bytes) {
        bytes.header(time_s, frame);
        bytes.number(static_cast<std::uint32_t>(scan.scan_packets.size()));
        double packet_s = time_s;
        for (const auto& packet : scan.scan_packets) {
            bytes.time(packet_s).raw(bytesOf(packet));
            packet_s += period_s;
        }
    });
}

SentMessage hesaiMessage(const std::string& topic, double time_s, const std::string& frame,
                         const std::vector<std::string>& packets, double period_s) {
    return sentMessage(topic, "pandar_msgs/PandarScan", time_s, [&](MessageBytes& bytes) {
        bytes.header(time_s, frame).number(static_cast<std::uint32_t>(packets.size()));
        double packet_s = time_s;
        for (const std::string& packet : packets) {
            bytes.time(packet_s).raw(packet + std::string(1500 - packet.size(), '\0'));
            bytes.number(static_cast<std::uint32_t>(packet.size()));
            packet_s += period_s;
        }
    });
}

SentMessage odometryMessage(const std::string& topic, double time_s, const std::string& frame,
                            const std::string& child, double x, double y, double z) {
    return sentMessage(topic, "nav_msgs/Odometry", time_s, [&](MessageBytes& bytes) {
        bytes.header(time_s, frame).text(child).pose(x, y, z);
        for (int i = 0; i < 36 + 6 + 36; ++i) bytes.number(0.0);
    });
}

SentMessage transformMessage(const std::string& topic, double time_s, const std::string& parent,
                             const std::string& child, double x, double y, double z) {
    return sentMessage(topic, "tf2_msgs/TFMessage", time_s, [&](MessageBytes& bytes) {
        bytes.number(std::uint32_t{1}).header(time_s, parent).text(child).pose(x, y, z);
    });
}

SentMessage stringMessage(const std::string& topic, double time_s, const std::string& text) {
    return sentMessage(topic, "std_msgs/String", time_s,
                       [&](MessageBytes& bytes) { bytes.text(text); });
}

ByteString packed(const ByteString& plain, const std::string& compression) {
    ByteString out(plain.size() + plain.size() / 50 + 70000, '\0');
    if (compression == "zstd") {
        out.resize(ZSTD_compress(out.data(), out.size(), plain.data(), plain.size(), 1));
    } else if (compression == "lz4") {
        out.resize(LZ4F_compressFrame(out.data(), out.size(), plain.data(), plain.size(), nullptr));
    } else if (compression == "bz2") {
        auto size = static_cast<unsigned>(out.size());
        BZ2_bzBuffToBuffCompress(out.data(), &size, const_cast<char*>(plain.data()),
                                 static_cast<unsigned>(plain.size()), 1, 0, 0);
        out.resize(size);
    } else {
        return plain;
    }
    return out;
}

ByteString ros1Record(const std::vector<std::pair<std::string, ByteString>>& fields,
                      const ByteString& data) {
    ByteString header;
    for (const auto& [name, value] : fields) {
        const ByteString field = name + "=" + value;
        header += little32(static_cast<std::uint32_t>(field.size())) + field;
    }
    return little32(static_cast<std::uint32_t>(header.size())) + header +
           little32(static_cast<std::uint32_t>(data.size())) + data;
}

ByteString ros1BagOf(const std::vector<SentMessage>& messages, const BagShape& shape) {
    const auto numbers = numbersOf(messages);
    ByteString chunks, infos;
    std::uint32_t chunk_count = 0;
    std::map<std::string, bool> is_described;
    for (std::size_t i = 0; i < messages.size(); i += shape.messages_per_chunk) {
        ByteString chunk;
        for (std::size_t k = i; k < std::min(messages.size(), i + shape.messages_per_chunk); ++k) {
            const SentMessage& message = messages[k];
            const std::string key = message.topic + " " + message.type;
            const ByteString connection = little32(numbers.at(key));
            if (!is_described[key]) {
                is_described[key] = true;
                ByteString more;
                for (const std::string& field :
                     {"topic=" + message.topic, "type=" + message.type, std::string("md5sum=*")}) {
                    more += little32(static_cast<std::uint32_t>(field.size())) + field;
                }
                chunk += ros1Record(
                    {{"op", "\x07"}, {"conn", connection}, {"topic", message.topic}}, more);
            }
            const std::uint64_t ns = nanoseconds(message.time_s);
            const ByteString time = little32(static_cast<std::uint32_t>(ns / 1000000000)) +
                                    little32(static_cast<std::uint32_t>(ns % 1000000000));
            chunk +=
                ros1Record({{"op", "\x02"}, {"conn", connection}, {"time", time}}, message.ros1);
        }
        chunks += ros1Record({{"op", "\x05"},
                              {"compression", shape.compression},
                              {"size", little32(static_cast<std::uint32_t>(chunk.size()))}},
                             packed(chunk, shape.compression));
        chunks += ros1Record({{"op", "\x04"}}, "an index");
        infos += ros1Record({{"op", "\x06"}}, "of a chunk");
        ++chunk_count;
    }
    const ByteString magic = "#ROSBAG V2.0\n";
    const auto headerWith = [&](std::uint64_t index_at) {
        return ros1Record({{"op", "\x03"},
                           {"index_pos", raw(index_at)},
                           {"conn_count", little32(static_cast<std::uint32_t>(numbers.size()))},
                           {"chunk_count", little32(chunk_count)}},
                          ByteString(4000, ' '));
    };
    const std::uint64_t index_at = magic.size() + headerWith(0).size() + chunks.size();
    if (!shape.is_closed) return magic + headerWith(0) + chunks;
    return magic + headerWith(index_at) + chunks + infos;
}

ByteString mcapRecord(unsigned op, const ByteString& content) {
    return ByteString(1, static_cast<char>(op)) + raw(static_cast<std::uint64_t>(content.size())) +
           content;
}

ByteString mcapOf(const std::vector<SentMessage>& messages, const BagShape& shape, bool is_ros1) {
    const ByteString magic("\x89MCAP0\r\n", 8);
    const auto numbers = numbersOf(messages);
    ByteString all = magic + mcapRecord(1, mcapText(is_ros1 ? "ros1" : "ros2") + mcapText("test"));
    std::map<std::string, bool> is_described;
    const std::size_t per_chunk = shape.messages_per_chunk == 0 ? 1 : shape.messages_per_chunk;
    for (std::size_t i = 0; i < messages.size(); i += per_chunk) {
        ByteString records;
        for (std::size_t k = i; k < std::min(messages.size(), i + per_chunk); ++k) {
            const SentMessage& message = messages[k];
            const std::string key = message.topic + " " + message.type;
            const ByteString id = raw(numbers.at(key));
            if (!is_described[key]) {
                is_described[key] = true;
                records +=
                    mcapRecord(3, id + mcapText(is_ros1 ? message.type : typeOfRos2(message.type)) +
                                      mcapText(is_ros1 ? "ros1msg" : "ros2msg") + mcapText(""));
                records += mcapRecord(4, id + id + mcapText(message.topic) +
                                             mcapText(is_ros1 ? "ros1" : "cdr") + little32(0));
            }
            const ByteString time = raw(nanoseconds(message.time_s));
            records += mcapRecord(5, id + little32(static_cast<std::uint32_t>(k)) + time + time +
                                         (is_ros1 ? message.ros1 : message.cdr));
        }
        if (shape.messages_per_chunk == 0) {
            all += records;
            continue;
        }
        const ByteString content = packed(records, shape.compression);
        const std::string name = shape.compression == "none" ? "" : shape.compression;
        all +=
            mcapRecord(6, ByteString(16, '\0') + raw(static_cast<std::uint64_t>(records.size())) +
                              little32(crcOf(records)) + mcapText(name) +
                              raw(static_cast<std::uint64_t>(content.size())) + content);
        all += mcapRecord(7, "an index");
    }
    all += mcapRecord(0x0f, little32(crcOf(all)));
    const std::uint64_t summary_at = all.size();
    ByteString summary = mcapRecord(0x0b, "statistics");
    // The CRC covers the summary and the footer up to the CRC.
    summary +=
        ByteString(1, '\2') + raw(std::uint64_t{20}) + raw(summary_at) + raw(std::uint64_t{0});
    return all + summary + little32(crcOf(summary)) + magic;
}

std::filesystem::path writeDb3(const std::filesystem::path& file,
                               const std::vector<SentMessage>& messages) {
    std::filesystem::remove(file);
    sqlite3* database = nullptr;
    sqlite3_open(file.c_str(), &database);
    const auto run = [&](const std::string& sql) {
        if (sqlite3_exec(database, sql.c_str(), nullptr, nullptr, nullptr) != SQLITE_OK) {
            throw std::runtime_error(sqlite3_errmsg(database));
        }
    };
    run("PRAGMA synchronous = OFF; BEGIN; CREATE TABLE topics(id INTEGER PRIMARY KEY, name TEXT "
        "NOT NULL, type TEXT NOT NULL,"
        " serialization_format TEXT NOT NULL, offered_qos_profiles TEXT NOT NULL);"
        "CREATE TABLE messages(id INTEGER PRIMARY KEY, topic_id INTEGER NOT NULL,"
        " timestamp INTEGER NOT NULL, data BLOB NOT NULL);"
        "CREATE INDEX timestamp_idx ON messages (timestamp ASC);");
    for (const auto& [key, number] : numbersOf(messages)) {
        const std::string topic = key.substr(0, key.find(' '));
        const std::string type = typeOfRos2(key.substr(key.find(' ') + 1));
        run("INSERT INTO topics VALUES (" + std::to_string(number) + ", '" + topic + "', '" + type +
            "', 'cdr', '')");
    }
    const auto numbers = numbersOf(messages);
    sqlite3_stmt* insert = nullptr;
    sqlite3_prepare_v2(database,
                       "INSERT INTO messages (topic_id, timestamp, data) VALUES (?, ?, ?)", -1,
                       &insert, nullptr);
    for (const SentMessage& message : messages) {
        sqlite3_bind_int(insert, 1, numbers.at(message.topic + " " + message.type));
        sqlite3_bind_int64(insert, 2, static_cast<sqlite3_int64>(nanoseconds(message.time_s)));
        sqlite3_bind_blob(insert, 3, message.cdr.data(), static_cast<int>(message.cdr.size()),
                          SQLITE_STATIC);
        sqlite3_step(insert);
        sqlite3_reset(insert);
    }
    sqlite3_finalize(insert);
    run("COMMIT");
    sqlite3_close(database);
    return file;
}

}  // namespace hagen::test
