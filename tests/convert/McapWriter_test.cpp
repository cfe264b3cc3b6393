#include "convert/McapWriter.h"
#include <gmock/gmock.h>
#include "recordings/bags/BagFile.h"

#include <tuple>

#include "support/BagWriter.h"
#include "support/Program.h"

namespace hagen::convert {
namespace {

namespace fs = std::filesystem;
using Bytes = std::vector<std::uint8_t>;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::StartsWith;

/// Topic, type, time [ns] and bytes.
using Read = std::tuple<std::string, std::string, std::int64_t, Bytes>;

std::vector<Read> readAll(const fs::path& file) {
    const auto bag = recordings::openBag(file);
    std::vector<Read> messages;
    for (recordings::BagMessage message; bag->next(message);) {
        const recordings::BagTopic& topic = bag->topics().at(message.topic);
        EXPECT_EQ(topic.encoding, "cdr");
        messages.emplace_back(topic.name, topic.type, message.time_ns,
                              Bytes(message.bytes, message.bytes + message.size));
    }
    const std::string damage = bag->takeDamage();
    if (!damage.empty()) throw std::runtime_error(damage);
    return messages;
}

std::uint64_t little(const std::string& bytes, std::size_t at, int size) {
    std::uint64_t number = 0;
    for (int i = size - 1; i >= 0; --i)
        number = number << 8 | static_cast<std::uint8_t>(bytes.at(at + i));
    return number;
}

/// Incompressible bytes.
Bytes noise(std::size_t size, std::uint32_t seed) {
    Bytes bytes(size);
    for (std::uint8_t& byte : bytes) {
        seed = 1664525 * seed + 1013904223;
        byte = static_cast<std::uint8_t>(seed >> 24);
    }
    return bytes;
}

std::string text(const Bytes& bytes) { return {bytes.begin(), bytes.end()}; }

class McapWriterTest : public testing::Test {
 protected:
    /// Writes clouds that fill several chunks, with poses between them and times out of order.
    std::vector<Read> write(const std::string& name, int messages = 12) const {
        McapWriter writer(folder_ / name, name);
        const std::uint16_t clouds = writer.addTopic("/a/points", pointCloud2Type());
        std::vector<Read> written;
        std::uint16_t poses = 0;
        for (int i = 0; i < messages; ++i) {
            const std::int64_t time_ns = 1700000000000000000 + 100000000LL * (i ^ 1);
            if (i == 3) poses = writer.addTopic("/a/pose", poseStampedType());
            const bool is_pose = i > 3 && i % 2 == 0;
            const Bytes bytes = noise(is_pose ? 50 : 400000, i);
            writer.write(is_pose ? poses : clouds, static_cast<std::uint64_t>(time_ns), bytes);
            written.emplace_back(is_pose ? "/a/pose" : "/a/points",
                                 is_pose ? "geometry_msgs/PoseStamped" : "sensor_msgs/PointCloud2",
                                 time_ns, bytes);
        }
        EXPECT_EQ(writer.messages(), written.size());
        writer.close();
        return written;
    }
    std::string bytesOf(const std::string& name) const { return test::readFile(folder_ / name); }

    test::TemporaryFolder folder_;
};

TEST_F(McapWriterTest, WritesReadableMessages) {
    const auto written = write("a.mcap");
    EXPECT_EQ(readAll(folder_ / "a.mcap"), written);
}

TEST_F(McapWriterTest, WritesReproducibleBytes) {
    write("a.mcap");
    write("b.mcap");
    EXPECT_TRUE(bytesOf("a.mcap") == bytesOf("b.mcap"));
}

/// Topic IDs are non-zero 16-bit numbers.
TEST_F(McapWriterTest, LimitsTopicsTo16Bits) {
    McapWriter writer(folder_ / "a.mcap", "a.mcap");
    for (int topic = 1; topic <= 65535; ++topic) {
        ASSERT_EQ(writer.addTopic("/t", poseStampedType()), topic);
    }
    EXPECT_THROW(writer.addTopic("/t", poseStampedType()), std::runtime_error);
}

TEST_F(McapWriterTest, WritesFileWithoutMessages) {
    write("a.mcap", 0);
    EXPECT_TRUE(readAll(folder_ / "a.mcap").empty());
}

/// Follows the footer to the summary, the chunk indices to the message indices, and these to the
/// message times, byte by byte as specified.
TEST_F(McapWriterTest, IndexesEveryMessage) {
    const auto written = write("a.mcap");
    const std::string bytes = bytesOf("a.mcap");
    const std::size_t footer = bytes.size() - 8 - 29;
    ASSERT_EQ(bytes[footer], 2);
    const std::size_t offsets = little(bytes, footer + 17, 8);
    std::size_t chunks = 0, placed = 0;
    std::vector<int> kinds;
    for (std::size_t at = little(bytes, footer + 9, 8); at < offsets;) {
        kinds.push_back(bytes[at]);
        const std::size_t content = at + 9;
        at = content + little(bytes, at + 1, 8);
        if (kinds.back() == 4) {  // a channel: two IDs, topic, encoding and an empty map
            std::size_t map = content + 4;
            for (int text = 0; text < 2; ++text) map += 4 + little(bytes, map, 4);
            EXPECT_EQ(little(bytes, map, 4), 0u);
            EXPECT_EQ(map + 4, at);
        }
        if (kinds.back() != 8) continue;
        ++chunks;
        const std::uint64_t first_ns = little(bytes, content, 8),
                            last_ns = little(bytes, content + 8, 8);
        const std::size_t chunk = little(bytes, content + 16, 8);
        ASSERT_EQ(bytes.at(chunk), 6);
        EXPECT_EQ(little(bytes, chunk + 1, 8) + 9, little(bytes, content + 24, 8));
        const std::size_t indices = little(bytes, content + 32, 4) / 10;
        for (std::size_t i = 0; i < indices; ++i) {
            const std::size_t index = little(bytes, content + 36 + 10 * i + 2, 8);
            ASSERT_EQ(bytes.at(index), 7);
            EXPECT_EQ(little(bytes, index + 9, 2), little(bytes, content + 36 + 10 * i, 2));
            const std::size_t entries = little(bytes, index + 11, 4) / 16;
            placed += entries;
            for (std::size_t k = 0; k < entries; ++k) {
                const std::uint64_t time_ns = little(bytes, index + 15 + 16 * k, 8);
                EXPECT_GE(time_ns, first_ns);
                EXPECT_LE(time_ns, last_ns);
            }
        }
    }
    EXPECT_GE(chunks, 2u);
    EXPECT_EQ(placed, written.size());
    EXPECT_EQ(bytes[offsets], 0x0e);
    const std::vector<int> first(kinds.begin(), kinds.begin() + 6);
    EXPECT_THAT(first, ElementsAre(3, 3, 4, 4, 0x0b, 8));
}

TEST_F(McapWriterTest, DetectsChangedBytes) {
    write("a.mcap");
    const std::string whole = bytesOf("a.mcap");
    const auto why = [&](std::size_t at) {
        std::string changed = whole;
        changed[at] = static_cast<char>(~changed[at]);
        const fs::path file = test::writeBytes(folder_ / "b.mcap", changed);
        return test::messageOf([&] { readAll(file); });
    };
    EXPECT_THAT(why(whole.find("hagen")), HasSubstr("the CRC of the data before it is wrong"));
    EXPECT_THAT(why(500000), HasSubstr("chunk"));
    EXPECT_THAT(why(whole.rfind("/a/pose")), HasSubstr("the CRC of the summary is wrong"));
}

TEST_F(McapWriterTest, ReportsTrailingBytes) {
    write("a.mcap");
    const std::string whole = bytesOf("a.mcap");
    for (const std::string& more : {whole, std::string("x"), std::string(1000, '\0')}) {
        const fs::path file = test::writeBytes(folder_ / "b.mcap", whole + more);
        EXPECT_THAT(
            test::messageOf([&] { readAll(file); }),
            HasSubstr("after the end of the recording (" + std::to_string(more.size()) + " B)"));
    }
}

TEST_F(McapWriterTest, ReportsWriteError) {
    EXPECT_THAT(test::messageOf([&] { McapWriter(folder_ / "none/a.mcap", "out.mcap"); }),
                StartsWith("out.mcap: cannot be written"));
    if (!fs::exists("/dev/full")) GTEST_SKIP() << "/dev/full does not exist";
    EXPECT_THAT(test::messageOf([&] {
                    McapWriter writer("/dev/full", "out.mcap");
                    writer.close();
                }),
                StartsWith("out.mcap: cannot be written"));
    EXPECT_THAT(test::messageOf([&] {
                    McapWriter writer("/dev/full", "out.mcap");
                    const std::uint16_t topic = writer.addTopic("/a", pointCloud2Type());
                    for (int i = 0; i < 9; ++i) writer.write(topic, 1, noise(1 << 20, i));
                }),
                StartsWith("out.mcap: cannot be written"));
}

// ---- messages, compared with those of the tests' own writer

const RosHeader kAt{1700000000250000000, "lidar"};
constexpr double kAt_s = 1700000000.25;

TEST(RosMessages, CloudsMatchTestWriter) {
    const std::vector<float> xyzi{1, 2, 3, 0.5f, -4, 5, -6, 0.25f};
    observations::PointTable table;
    table.points = 2;
    for (std::size_t k = 0; k < 4; ++k) {
        addColumn(std::vector<const char*>{"x", "y", "z", "intensity"}[k],
                  observations::NumberType::Float32, {xyzi[k], xyzi[4 + k]}, table);
    }
    EXPECT_EQ(text(pointCloud2Message(kAt, table)),
              test::cloudMessage("", kAt_s, "lidar", xyzi).cdr);
}

TEST(RosMessages, MarkNonFinitePoints) {
    observations::PointTable table;
    table.points = 1;
    for (const char* const name : {"x", "y", "z"})
        addColumn(name, observations::NumberType::Float32, {0}, table);
    EXPECT_EQ(pointCloud2Message(kAt, table).back(), 1);
    table.bytes[7] = 0x7f;  // y
    table.bytes[6] = 0xc0;
    EXPECT_EQ(pointCloud2Message(kAt, table).back(), 0);
}

TEST(RosMessages, RejectUnsupportedValues) {
    observations::PointTable table;
    table.points = 1;
    addColumn("t", observations::NumberType::Int64, {0}, table);
    EXPECT_THAT(test::messageOf([&] { pointCloud2Message(kAt, table); }),
                HasSubstr("the field 't' of type int64"));
    for (const std::int64_t time_ns : {std::int64_t{-1}, std::int64_t{1} << 62}) {
        EXPECT_THAT(test::messageOf([&] { poseMessage({time_ns, "map"}, {}); }), HasSubstr("1970"));
    }
}

TEST(RosMessages, PosesMatchTestWriter) {
    const mrpt::poses::CPose3D turned(1, -2, 3, 0.5, 0, 0), level(4, 5, 6, 0, 0, 0);
    test::MessageBytes pose(true);
    pose.header(kAt_s, "lidar").pose(1, -2, 3, 0.5);
    EXPECT_EQ(text(poseMessage(kAt, turned)), pose.bytes());
    EXPECT_EQ(text(transformMessage({kAt.time_ns, "map"}, "lidar", level)),
              test::transformMessage("/tf", kAt_s, "map", "lidar", 4, 5, 6).cdr);
}

TEST(RosMessages, BoxesReplaceOldMarkers) {
    const RoiBox box{7, 40, 2.0f, {Eigen::Vector3f(1, 2, 3), Eigen::Vector3f(3, 2, 7)}};
    test::MessageBytes expected(true);
    expected.number(std::uint32_t{2});
    const auto add = [&](const char* ns, int id, int action, const std::vector<double>& numbers) {
        expected.header(kAt_s, "lidar").text(ns).number(id).number(1).number(action);
        expected.pose(numbers[0], numbers[1], numbers[2]);
        for (int k = 3; k < 6; ++k) expected.number(numbers[k]);
        for (const float part : {1.0f, 0.75f, 0.47f, 0.35f}) expected.number(part);
        expected.number(0).number(0).number(std::uint8_t{0});  // lifetime, frame_locked
        expected.number(0).number(0).text("");                 // points, colours, texture
        expected.number(0).number(0).text("").text("").number(0).number(0);
        expected.text("").text("").text("").number(0).number(std::uint8_t{0});
    };
    const double thin = 0.01f;
    add("", 0, 3, {0, 0, 0, thin, thin, thin});
    add("obstacles", 7, 0, {2, 2, 5, 2, thin, 4});
    EXPECT_EQ(text(boxesMessage(kAt, {box})), expected.bytes());
}

}  // namespace
}  // namespace hagen::convert
