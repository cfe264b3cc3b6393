#include "recordings/bags/BagFile.h"
#include <gmock/gmock.h>

#include <sqlite3.h>

#include "support/BagWriter.h"
#include "support/Program.h"
#include "support/RawBytes.h"

namespace hagen::recordings {
namespace {

using test::BagShape;
using test::ByteString;
using test::raw;
using testing::HasSubstr;

namespace fs = std::filesystem;

/// "/topic type time bytes" for each message.
struct Read {
    std::vector<std::string> messages;
    std::string broken_because;
    double fraction = 0;
};

Read readAll(const fs::path& file) {
    Read read;
    std::unique_ptr<BagFile> bag;
    try {
        bag = openBag(file);
        BagMessage message;
        while (bag->next(message)) {
            if (read.broken_because.empty()) read.broken_because = bag->takeDamage();
            const BagTopic& topic = bag->topics().at(message.topic);
            read.messages.push_back(
                topic.name + " " + topic.type + " " + topic.encoding + " " +
                std::to_string(message.time_ns) + " " +
                std::string(reinterpret_cast<const char*>(message.bytes), message.size));
            EXPECT_GE(bag->fractionRead(), read.fraction);
            read.fraction = bag->fractionRead();
        }
        read.fraction = bag->fractionRead();
        if (read.broken_because.empty()) read.broken_because = bag->takeDamage();
        EXPECT_FALSE(bag->next(message));
    } catch (const BrokenRecording& e) {
        if (bag) read.broken_because += bag->takeDamage();
        if (read.broken_because.empty()) read.broken_because = e.what();
    }
    return read;
}

std::vector<test::SentMessage> someMessages() {
    std::vector<test::SentMessage> messages;
    for (int i = 0; i < 10; ++i) {
        messages.push_back(test::stringMessage(i % 3 == 0 ? "/a" : "/b", 1700000000 + 0.1 * i,
                                               std::string(100 + i, static_cast<char>('a' + i))));
    }
    return messages;
}

std::vector<std::string> expected(bool is_ros1) {
    std::vector<std::string> texts;
    for (const test::SentMessage& message : someMessages()) {
        texts.push_back(message.topic + " " + message.type + (is_ros1 ? " ros1 " : " cdr ") +
                        std::to_string(std::llround(10 * message.time_s)) + "00000000 " +
                        (is_ros1 ? message.ros1 : message.cdr));
    }
    return texts;
}

class BagFileTest : public testing::Test {
 protected:
    Read readBytes(const ByteString& bytes) const {
        return readAll(test::writeBytes(folder_ / "file", bytes));
    }
    /// Expects an error that contains the file name and these words.
    void expectBroken(const ByteString& bytes, const std::string& words) const {
        const std::string why = readBytes(bytes).broken_because;
        EXPECT_THAT(why, HasSubstr((folder_ / "file").string() + ": "));
        EXPECT_THAT(why, HasSubstr(words));
    }
    test::TemporaryFolder folder_;
};

TEST_F(BagFileTest, ReadsEveryFormat) {
    for (const char* compression : {"none", "bz2", "lz4"}) {
        const Read read = readBytes(test::ros1BagOf(someMessages(), {compression}));
        EXPECT_EQ(read.broken_because, "");
        EXPECT_EQ(read.messages, expected(true)) << compression;
        EXPECT_EQ(read.fraction, 1.0);
    }
    for (const char* compression : {"none", "zstd", "lz4"}) {
        for (const std::size_t per_chunk : {0, 1, 4}) {
            const Read read = readBytes(test::mcapOf(someMessages(), {compression, per_chunk}));
            EXPECT_EQ(read.broken_because, "");
            EXPECT_EQ(read.messages, expected(false)) << compression << per_chunk;
            EXPECT_EQ(read.fraction, 1.0);
        }
    }
    EXPECT_EQ(readBytes(test::mcapOf(someMessages(), {}, true)).messages, expected(true));
    const Read read = readAll(test::writeDb3(folder_ / "a.db3", someMessages()));
    EXPECT_EQ(read.broken_because, "");
    EXPECT_EQ(read.messages, expected(false));
    EXPECT_EQ(read.fraction, 1.0);
}

/// Reads files of other programs in tests/recordings/data; see the README there.
TEST_F(BagFileTest, ReadsFilesFromOtherPrograms) {
    const fs::path data = fs::path(HAGEN_SOURCE_DIR) / "tests/recordings/data";
    const Read ros2 = readAll(data / "flight_zstd.mcap");
    EXPECT_EQ(ros2.broken_because, "");
    ASSERT_EQ(ros2.messages.size(), 33u);
    EXPECT_THAT(ros2.messages[0],
                HasSubstr("/tf_static tf2_msgs/TFMessage cdr 1700000000000000000 "));
    EXPECT_THAT(ros2.messages.back(), HasSubstr("of something else"));
    // ROS 1 messages in bags are from rosbag, those in the MCAP from another serialiser.
    const Read ros1 = readAll(data / "flight_ros1.mcap");
    EXPECT_EQ(ros1.messages.size(), 33u);
    for (const char* file : {"flight_bz2.bag", "flight_lz4.bag"}) {
        const Read read = readAll(data / file);
        EXPECT_EQ(read.broken_because, "");
        EXPECT_EQ(read.messages.size(), 33u) << file;
        EXPECT_EQ(read.messages[20], ros1.messages[20]);
    }
}

TEST_F(BagFileTest, ReadsUpToAnyTruncation) {
    const std::vector<ByteString> files{
        test::ros1BagOf(someMessages()),
        test::ros1BagOf(someMessages(), {"lz4"}),
        test::mcapOf(someMessages()),
        test::mcapOf(someMessages(), {"zstd"}),
        test::mcapOf(someMessages(), {"none", 0}),
        test::readFile(test::writeDb3(folder_ / "a.db3", someMessages()))};
    for (const ByteString& whole : files) {
        const std::vector<std::string> all = readBytes(whole).messages;
        ASSERT_EQ(all.size(), 10u);
        for (std::size_t cut = 1; cut <= 50; ++cut) {
            const std::size_t size = whole.size() - 1 - (50 - cut) * (whole.size() - 20) / 50;
            const Read read = readBytes(whole.substr(0, size));
            // The last pages of a database and the summary of an MCAP have no messages.
            const bool is_whole = read.messages == all;
            EXPECT_THAT(read.broken_because, HasSubstr(is_whole ? "" : "file: "))
                << size << " of " << whole.size();
            ASSERT_LE(read.messages.size(), all.size());
            EXPECT_TRUE(std::equal(read.messages.begin(), read.messages.end(), all.begin()));
        }
    }
    // Messages before the truncation are kept, even in a database.
    std::vector<test::SentMessage> large;
    for (int i = 0; i < 10; ++i) {
        large.push_back(test::stringMessage("/a", i, std::string(20000, 'a')));
    }
    const fs::path database = test::writeDb3(folder_ / "a.db3", large);
    fs::resize_file(database, fs::file_size(database) / 2);
    EXPECT_GE(readAll(database).messages.size(), 4u);
    const ByteString plain = test::mcapOf(someMessages(), {"none", 0});
    EXPECT_GE(readBytes(plain.substr(0, plain.size() / 2)).messages.size(), 4u);
}

TEST_F(BagFileTest, SurvivesChangedBytes) {
    for (const ByteString& whole :
         {test::ros1BagOf(someMessages(), {"bz2"}), test::mcapOf(someMessages(), {"lz4"}),
          test::readFile(test::writeDb3(folder_ / "a.db3", someMessages()))}) {
        for (std::size_t at = 0; at < whole.size(); at += whole.size() / 100) {
            ByteString changed = whole;
            changed[at] = static_cast<char>(~changed[at]);
            EXPECT_LE(readBytes(changed).messages.size(), 10u);
        }
    }
}

TEST_F(BagFileTest, DetectsChangedDataByCrc) {
    ByteString mcap = test::mcapOf(someMessages());
    mcap[mcap.find("dddd")] = 'x';
    expectBroken(mcap, "the CRC of the chunk is wrong");
    mcap = test::mcapOf(someMessages(), {"none", 0});
    mcap[mcap.find("dddd")] = 'x';
    expectBroken(mcap, "the CRC of the data before it is wrong");
}

TEST_F(BagFileTest, RejectsWrongSizesAndCounts) {
    const ByteString magic("\x89MCAP0\r\n", 8), far = ByteString(7, '\xff') + '\x7f';
    expectBroken(magic + '\x05' + far, "claims 9223372036854775807 bytes");
    expectBroken(magic + '\x0b' + far, "is truncated: expected 9223372036854775807 bytes, found 0");
    expectBroken(magic + '\x06' + ByteString("\0\0\0\x10\0\0\0\0", 8),
                 "a chunk at byte 17: is truncated");
    const auto chunk = [&](const ByteString& size, const ByteString& name) {
        return magic +
               test::mcapRecord(6, ByteString(16, '\0') + size + ByteString(4, '\0') +
                                       test::little32(static_cast<std::uint32_t>(name.size())) +
                                       name + ByteString("\4\0\0\0\0\0\0\0abcd", 12));
    };
    expectBroken(chunk(far, "zstd"), "it claims a size of 9223372036854775807 bytes, more than");
    expectBroken(
        chunk(ByteString("\4\0\0\0\0\0\0\0", 8), "brotli"),
        "the chunk at byte 8: cannot be decompressed: its compression 'brotli' is not supported");
    expectBroken(chunk(ByteString("\4\0\0\0\0\0\0\0", 8), "zstd"), "cannot be decompressed: ");
    expectBroken(chunk(ByteString("\4\0\0\0\0\0\0\0", 8), "lz4"), "cannot be decompressed: ");
    expectBroken(chunk(ByteString("\5\0\0\0\0\0\0\0", 8), ""), "it has 4 bytes, but claims 5");
    expectBroken(magic + test::mcapRecord(5, ByteString(22, '\3')),
                 "to channel 771, which is not defined");
    expectBroken(magic + test::mcapRecord(5, "a"), "a message is too short");

    const ByteString ros1 = "#ROSBAG V2.0\n";
    expectBroken(ros1 + "\xff\xff\xff\xff", "its header claims 4294967295 bytes");
    expectBroken(ros1 + test::ros1Record({}, ""), "its header has no 'op'");
    expectBroken(ros1 + test::ros1Record({{"op", "12"}}, ""),
                 "'op' in its header has 2 bytes, not 1");
    expectBroken(
        ros1 + test::ros1Record({{"op", "\x02"}, {"conn", "abcd"}, {"time", "12345678"}}, ""),
        "to connection 1684234849, which is not defined");
    expectBroken(
        ros1 + test::ros1Record(
                   {{"op", "\x05"}, {"compression", "lz4"}, {"size", "\xff\xff\xff\x7f"}}, "abcd"),
        "it claims a size of 2147483647 bytes");
    expectBroken(test::ros1BagOf(someMessages(), {"xz"}), "its compression 'xz' is not supported");
}

TEST_F(BagFileTest, ReadsUnclosedRos1Bag) {
    BagShape shape;
    shape.is_closed = false;
    const Read read = readBytes(test::ros1BagOf(someMessages(), shape));
    EXPECT_EQ(read.messages, expected(true));
    EXPECT_THAT(read.broken_because, HasSubstr("without an index: it was not closed"));
}

TEST_F(BagFileTest, RejectsOtherVersionsAndEncryption) {
    expectBroken("#ROSBAG V1.2\nabcd", "is '#ROSBAG V1.2'; only format 2.0 is supported");
    expectBroken(
        "#ROSBAG V2.0\n" +
            test::ros1Record({{"op", "\x03"}, {"encryptor", "rosbag/AesCbcEncryptor"}}, ""),
        "the bag is encrypted (rosbag/AesCbcEncryptor)");
    expectBroken("some text", "is neither a ROS 1 bag, nor an MCAP, nor a database of a ROS 2 bag");
    EXPECT_FALSE(isBag(test::writeBytes(folder_ / "text", "some text")));
    EXPECT_FALSE(isBag(test::writeBytes(folder_ / "empty", "")));
}

TEST_F(BagFileTest, RejectsOtherDatabases) {
    const fs::path file = folder_ / "other.db3";
    sqlite3* database = nullptr;
    sqlite3_open(file.c_str(), &database);
    sqlite3_exec(database, "CREATE TABLE songs(id INTEGER)", nullptr, nullptr, nullptr);
    sqlite3_close(database);
    EXPECT_THAT(readAll(file).broken_because, HasSubstr("at its start: no such table: topics"));
    test::writeDb3(file, someMessages());
    sqlite3_open(file.c_str(), &database);
    sqlite3_exec(database, "UPDATE messages SET topic_id = 9 WHERE id = 5", nullptr, nullptr,
                 nullptr);
    sqlite3_close(database);
    const Read read = readAll(file);
    EXPECT_EQ(read.messages.size(), 4u);
    EXPECT_THAT(read.broken_because,
                HasSubstr("after 4 messages (id 5): this message belongs to topic 9"));
}

TEST_F(BagFileTest, AcceptsPathWithTwoSlashes) {
    const fs::path file = test::writeDb3(folder_ / "a.db3", someMessages());
    EXPECT_EQ(readAll("/" + file.string()).messages, expected(false));
}

TEST_F(BagFileTest, RejectsDatabaseWithHotJournal) {
    const fs::path file = test::writeDb3(folder_ / "a.db3", someMessages());
    const fs::path copy = folder_ / "b.db3", journal = folder_ / "b.db3-journal";
    sqlite3* database = nullptr;
    sqlite3_open(file.c_str(), &database);
    const auto run = [&](const std::string& sql) {
        EXPECT_EQ(sqlite3_exec(database, sql.c_str(), nullptr, nullptr, nullptr), SQLITE_OK);
    };
    // The transaction exceeds the cache, so part of it is written to the file before it ends.
    run("PRAGMA cache_size = 5; BEGIN; UPDATE messages SET timestamp = 7;"
        "WITH RECURSIVE n(i) AS (SELECT 1 UNION ALL SELECT i + 1 FROM n LIMIT 500) "
        "INSERT INTO messages (topic_id, timestamp, data) SELECT 1, i, zeroblob(4000) FROM n");
    fs::copy_file(file, copy);
    fs::copy_file(folder_ / "a.db3-journal", journal);
    run("ROLLBACK");
    sqlite3_close(database);
    const Read read = readAll(copy);
    EXPECT_EQ(read.messages.size(), 0u);
    EXPECT_THAT(read.broken_because, HasSubstr("its writer was interrupted: copy it"));
    // As the message suggests, a query by a process with write permission undoes the transaction.
    sqlite3_open(copy.c_str(), &database);
    run("SELECT count(*) FROM messages");
    sqlite3_close(database);
    EXPECT_EQ(readAll(copy).messages, expected(false));
    // A journal may remain after the transaction.
    test::writeBytes(journal, ByteString(512, '\0'));
    EXPECT_EQ(readAll(copy).messages, expected(false));
}

TEST_F(BagFileTest, LeavesFolderUnchanged) {
    readAll(test::writeDb3(folder_ / "a%20b #1.db3", someMessages()));
    std::size_t files = 0;
    for (const auto& file : fs::directory_iterator(folder_.path())) files += file.exists();
    EXPECT_EQ(files, 1u);
}

class BagFolderTest : public BagFileTest {
 protected:
    BagFolderTest() {
        fs::create_directory(folder_ / "bag");
        const auto all = someMessages();
        std::vector<test::SentMessage> part;
        for (std::size_t i = 0; i < all.size(); ++i) {
            part.push_back(all[i]);
            if (part.size() < 4 && i + 1 < all.size()) continue;
            test::writeBytes(folder_ / ("bag/bag_" + std::to_string(8 + file_count_++) + ".mcap"),
                             test::mcapOf(part));
            part.clear();
        }
    }
    void writeMetadata(const std::string& more = "",
                       const std::string& files = "[bag_8.mcap, bag/bag_9.mcap, bag_10.mcap]") {
        test::writeBytes(folder_ / "bag/metadata.yaml",
                         "rosbag2_bagfile_information:\n  version: 5\n" + more +
                             "  relative_file_paths: " + files + "\n");
    }
    std::size_t file_count_ = 0;
};

TEST_F(BagFolderTest, ReadsFilesInOrder) {
    EXPECT_TRUE(isBag(folder_ / "bag"));
    EXPECT_EQ(readAll(folder_ / "bag").messages, expected(false));  // bag_10 is last
    writeMetadata();
    EXPECT_TRUE(isBag(folder_ / "bag"));
    const Read read = readAll(folder_ / "bag");
    EXPECT_EQ(read.messages, expected(false));
    EXPECT_EQ(read.fraction, 1.0);
    writeMetadata("", "[bag_9.mcap]");
    EXPECT_EQ(readAll(folder_ / "bag").messages.size(), 4u);
}

TEST_F(BagFolderTest, ReportsDamageAtEndOfFile) {
    for (const char* name : {"bag/bag_8.mcap", "bag/bag_10.mcap"}) {
        const ByteString whole = test::readFile(folder_ / name);
        ByteString changed = whole;
        changed[whole.size() / 3] = static_cast<char>(~changed[whole.size() / 3]);
        test::writeBytes(folder_ / name, changed);
        EXPECT_THAT(readAll(folder_ / "bag").broken_because, HasSubstr("the chunk at byte"));
        test::writeBytes(folder_ / name, whole);
    }
}

TEST_F(BagFolderTest, RejectsInvalidMetadata) {
    writeMetadata("", "[bag_8.mcap, bag_99.mcap]");
    EXPECT_THAT(readAll(folder_ / "bag").broken_because,
                HasSubstr("metadata.yaml: lists 'bag_99.mcap', which is not in the folder"));
    writeMetadata("", "[]");
    EXPECT_THAT(readAll(folder_ / "bag").broken_because,
                HasSubstr("metadata.yaml: lists no files"));
    writeMetadata("  compression_mode: FILE\n  compression_format: zstd\n");
    EXPECT_THAT(readAll(folder_ / "bag").broken_because, HasSubstr("compressed as a whole (zstd)"));
    // Metadata must not list files outside the folder.
    writeMetadata("", "[../../etc/passwd]");
    EXPECT_THAT(readAll(folder_ / "bag").broken_because, HasSubstr("lists 'passwd', which is not"));
    writeMetadata("", "{a: b}");
    EXPECT_THAT(readAll(folder_ / "bag").broken_because, HasSubstr("metadata.yaml: "));
}

TEST_F(BagFolderTest, IgnoresOtherFolders) {
    fs::create_directories(folder_ / "scans/velodyne");
    EXPECT_FALSE(isBag(folder_ / "scans"));
    fs::create_directory(folder_ / "none");
    EXPECT_FALSE(isBag(folder_ / "none"));
    test::writeBytes(folder_ / "none/metadata.yaml", "title: photos\n");
    EXPECT_FALSE(isBag(folder_ / "none"));
}

TEST_F(BagFolderTest, ReportsBrokenFile) {
    const fs::path second = folder_ / "bag/bag_9.mcap";
    fs::resize_file(second, fs::file_size(second) / 2);
    const Read read = readAll(folder_ / "bag");
    EXPECT_GE(read.messages.size(), 4u);
    EXPECT_LE(read.messages.size(), 8u);
    EXPECT_THAT(read.broken_because, HasSubstr("bag_9.mcap: "));
}

/// Counts the calls of a check and stops reading with an exception after a number of calls.
struct Ending {
    struct Ended : std::runtime_error {
        using std::runtime_error::runtime_error;
    };
    int calls = 0;

    bool ends(const fs::path& file, int max_calls) {
        const auto bag = openBag(file);
        bag->checkWhileReading([&] {
            if (++calls > max_calls) throw Ended("ended");
        });
        BagMessage message;
        try {
            while (bag->next(message)) {
            }
        } catch (const Ended&) {
            return true;
        }
        return false;
    }
};

TEST_F(BagFileTest, InterruptsBetweenMessages) {
    const ByteString magic("\x89MCAP0\r\n", 8);
    ByteString schemas;
    for (int i = 0; i < 50; ++i) schemas += test::mcapRecord(3, ByteString(14, '\0'));
    const ByteString chunk = ByteString(16, '\0') + raw(std::uint64_t{schemas.size()}) +
                             ByteString(8, '\0') + raw(std::uint64_t{schemas.size()}) + schemas;
    // Tests records of a file and of a chunk, an attachment, and sections of a ROS 1 bag.
    const fs::path attachment =
        test::writeBytes(folder_ / "a", magic + '\x09' + raw(std::uint64_t{4000000000}));
    fs::resize_file(attachment, 4000000017u);  // sparse
    const fs::path ros1 = test::writeBytes(
        folder_ / "r",
        "#ROSBAG V2.0\n" + test::ros1Record({{"op", "\x04"}}, ByteString(4000000, 'a')));
    for (const fs::path& file :
         {test::writeBytes(folder_ / "s", magic + schemas),
          test::writeBytes(folder_ / "c", magic + test::mcapRecord(6, chunk)), attachment, ros1}) {
        Ending ending;
        EXPECT_TRUE(ending.ends(file, 20)) << file;
        EXPECT_EQ(ending.calls, 21) << file;
    }
}

TEST_F(BagFileTest, RejectsZeroedChunk) {
    const ByteString chunk = ByteString(16, '\0') + raw(std::uint64_t{900}) + ByteString(8, '\0') +
                             raw(std::uint64_t{900}) + ByteString(900, '\0');
    expectBroken(ByteString("\x89MCAP0\r\n", 8) + test::mcapRecord(6, chunk),
                 "the chunk at byte 8: it contains a record of the invalid type 0");
}

TEST_F(BagFolderTest, ReportsIgnoredMetadata) {
    EXPECT_THAT(openBag(folder_ / "bag")->remarks(), testing::IsEmpty());
    for (const std::string text : {"", "a: [", "title: photos\n", "- a\n", "just text"}) {
        test::writeBytes(folder_ / "bag/metadata.yaml", text);
        EXPECT_TRUE(isBag(folder_ / "bag")) << text;
        const Read read = readAll(folder_ / "bag");
        EXPECT_EQ(read.messages, expected(false)) << text;
        EXPECT_EQ(read.broken_because, "") << text;
        EXPECT_THAT(openBag(folder_ / "bag")->remarks(),
                    testing::ElementsAre(HasSubstr("metadata.yaml is ignored")))
            << text;
    }
    writeMetadata();
    EXPECT_THAT(openBag(folder_ / "bag")->remarks(), testing::IsEmpty());
}

TEST_F(BagFolderTest, ReportsUnlistedFiles) {
    writeMetadata("", "[bag_9.mcap]");
    EXPECT_THAT(openBag(folder_ / "bag")->remarks(),
                testing::ElementsAre(HasSubstr("does not list all files in the folder; ignored: "
                                               "'bag_8.mcap' 'bag_10.mcap'")));
    writeMetadata("", "[bag_8.mcap, bag_8.mcap, bag_9.mcap, bag/bag_8.mcap, bag_10.mcap]");
    EXPECT_EQ(readAll(folder_ / "bag").messages, expected(false));
}

TEST_F(BagFolderTest, IgnoresOtherFiles) {
    for (const char* name : {"a.rawlog", "b.bag", "c.pcap", "readme.txt", "bag_8.db3-wal"}) {
        test::writeBytes(folder_ / "bag" / name, "x");
    }
    fs::rename(folder_ / "bag/bag_10.mcap", folder_ / "bag/bag_10.MCAP");
    EXPECT_EQ(readAll(folder_ / "bag").messages, expected(false));
}

TEST_F(BagFolderTest, RejectsFolderWithoutFiles) {
    fs::create_directory(folder_ / "none");
    EXPECT_THAT(readAll(folder_ / "none").broken_because,
                HasSubstr("none: has no .mcap and no .db3 files"));
}

}  // namespace
}  // namespace hagen::recordings
