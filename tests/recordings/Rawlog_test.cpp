// Compares RawlogReader and RawlogWriter with each other and with MRPT's CRawlog.
#include <gmock/gmock.h>
#include <hagen/recordings/RawlogReader.h>
#include <mrpt/io/CFileOutputStream.h>
#include <mrpt/obs/CObservationRobotPose.h>
#include <mrpt/obs/CRawlog.h>
#include <zlib.h>
#include "convert/GzipOutput.h"
#include "convert/RawlogWriter.h"
#include "recordings/rawlogs/PackedInput.h"

#include <cstdlib>

#include "support/Program.h"
#include "support/Random.h"
#include "support/ReadRawlog.h"

namespace hagen::recordings {
namespace {

using test::comment;
using test::readLog;
using testing::HasSubstr;

namespace fs = std::filesystem;
using mrpt::obs::CObservationComment;

/// A log of comments "0", "1", ... with incompressible random text.
void writeLog(const fs::path& file, int entries) {
    convert::RawlogWriter writer(file, true);
    for (int i = 0; i < entries; ++i) {
        std::string text = std::to_string(i) + " ";
        for (int k = 0; k < 300; ++k) text += static_cast<char>('a' + (i * 7919 + k * k * 31) % 26);
        writer.write(comment(text));
    }
    writer.commit();
}

class Rawlog : public testing::Test {
 protected:
    const test::TemporaryFolder folder_;
};

TEST_F(Rawlog, ReadsEntriesInOrder) {
    writeLog(folder_ / "a.rawlog", 20);
    RawlogReader reader(folder_ / "a.rawlog");
    for (int i = 0; i < 20; ++i) {
        const auto entry = std::dynamic_pointer_cast<CObservationComment>(reader.next());
        ASSERT_NE(entry, nullptr);
        EXPECT_EQ(std::stoi(entry->text), i);
    }
    EXPECT_EQ(reader.next(), nullptr);
    EXPECT_EQ(reader.next(), nullptr);
    EXPECT_EQ(reader.entries(), 20u);
}

TEST_F(Rawlog, MrptReadsOutput) {
    test::Random random(1);
    std::vector<std::string> texts;
    for (const std::size_t size : {0, 1, 1000, 70000, 300000}) {
        for (const int max : {1, 25, 255}) {  // the last cannot be compressed
            std::string& text = texts.emplace_back(size, '\0');
            for (char& letter : text) letter = static_cast<char>(random.whole(0, max));
        }
    }
    convert::RawlogWriter writer(folder_ / "a.rawlog", false);
    for (const std::string& text : texts) {
        mrpt::obs::CObservationRobotPose entry;
        entry.sensorLabel = text;
        writer.write(entry);
    }
    writer.commit();
    mrpt::obs::CRawlog rawlog;
    ASSERT_TRUE(rawlog.loadFromRawLogFile((folder_ / "a.rawlog").string()));
    ASSERT_EQ(rawlog.size(), texts.size());
    for (std::size_t i = 0; i < texts.size(); ++i) {
        EXPECT_TRUE(rawlog.getAsObservation(i)->sensorLabel == texts[i]) << i;
    }
}

TEST_F(Rawlog, WritesReproducibleBytes) {
    writeLog(folder_ / "a.rawlog", 20);
    writeLog(folder_ / "b.rawlog", 20);
    EXPECT_EQ(test::readFile(folder_ / "a.rawlog"), test::readFile(folder_ / "b.rawlog"));
}

TEST_F(Rawlog, ReadsEntriesBeforeTruncation) {
    for (const int entries : {3, 20}) {
        writeLog(folder_ / "whole.rawlog", entries);
        const std::string bytes = test::readFile(folder_ / "whole.rawlog");
        for (std::size_t length = 1; length < bytes.size(); ++length) {
            const auto [read, broken] =
                readLog(folder_.write("cut.rawlog", bytes.substr(0, length)));
            ASSERT_NE(broken, "") << length << " of " << bytes.size();
            ASSERT_LE(read, static_cast<std::size_t>(entries));
        }
        EXPECT_EQ(readLog(folder_ / "whole.rawlog"),
                  (std::pair<std::size_t, std::string>(entries, "")));
    }
}

TEST_F(Rawlog, ReadsTruncatedUncompressedLog) {
    std::string bytes;
    {
        mrpt::io::CFileOutputStream stream((folder_ / "plain.rawlog").string());
        auto archive = mrpt::serialization::archiveFrom(stream);
        for (int i = 0; i < 3; ++i) archive << comment("plain " + std::to_string(i));
    }
    bytes = test::readFile(folder_ / "plain.rawlog");
    EXPECT_EQ(readLog(folder_ / "plain.rawlog").first, 3u);
    const std::size_t entry = bytes.size() / 3;  // all entries have the same size
    for (std::size_t length = 1; length < bytes.size(); ++length) {
        const auto [read, broken] = readLog(folder_.write("cut.rawlog", bytes.substr(0, length)));
        ASSERT_EQ(read, length / entry);
        ASSERT_EQ(broken.empty(), length % entry == 0) << length;
    }
}

TEST_F(Rawlog, ReadsConcatenatedMembers) {
    writeLog(folder_ / "a.rawlog", 3);
    const std::string bytes = test::readFile(folder_ / "a.rawlog");
    EXPECT_EQ(readLog(folder_.write("twice.rawlog", bytes + bytes)).first, 6u);
}

/// Writes a log with one entry per member; returns the file size after each.
std::vector<std::size_t> writeLargeEntries(const fs::path& file, int entries) {
    convert::RawlogWriter writer(file, true);
    std::vector<std::size_t> ends;
    convert::Bytes bytes, member, packed;
    for (int i = 0; i < entries; ++i) {
        bytes.clear();
        mrpt::obs::CObservationRobotPose entry;
        entry.sensorLabel = std::string(300000, static_cast<char>('a' + i));
        convert::serialise(entry, bytes);
        member.clear();
        writer.gather(bytes, member);
        convert::packGzipMember(member, packed);
        writer.writeMember(packed);
        ends.push_back(packed.size() + (ends.empty() ? 0 : ends.back()));
    }
    writer.commit();
    return ends;
}

/// Tapes and preallocation append zeros, which gzip(1) also ignores.
TEST_F(Rawlog, IgnoresTrailingZeros) {
    writeLog(folder_ / "a.rawlog", 20);
    const std::string log = test::readFile(folder_ / "a.rawlog");
    for (const std::size_t zeros : {1u, 512u, 300000u}) {
        RawlogReader reader(folder_.write("zeros.rawlog", log + std::string(zeros, '\0')));
        while (reader.next()) {
        }
        EXPECT_EQ(reader.entries(), 20u);
    }
    RawlogReader other(folder_.write("other.rawlog", log + std::string(512, '\0') + "x"));
    EXPECT_THROW(while (other.next()){}, BrokenRecording);
}

TEST_F(Rawlog, ContinuesIfFileIsRemoved) {
    writeLog(folder_ / "a.rawlog", 20);
    RawlogReader reader(folder_ / "a.rawlog");
    ASSERT_NE(reader.next(), nullptr);
    fs::remove(folder_ / "a.rawlog");
    while (reader.next()) EXPECT_GT(reader.fractionRead(), 0);
    EXPECT_EQ(reader.entries(), 20u);
    EXPECT_EQ(reader.fractionRead(), 1.0);
}

TEST_F(Rawlog, EndsMembersBetweenEntries) {
    convert::RawlogWriter writer(folder_ / "a.rawlog", false);
    convert::Bytes small(1000, 1), member;
    for (int i = 0; i < 262; ++i) {
        convert::Bytes entries = small;
        writer.gather(entries, member);
        ASSERT_TRUE(member.empty()) << i;
    }
    convert::Bytes entries(5000, 2);  // starts before 256 KiB and ends beyond
    writer.gather(entries, member);
    ASSERT_EQ(member.size(), 267000u);
    EXPECT_EQ(member.front(), 1);
    EXPECT_EQ(member.back(), 2);
    entries = small;
    writer.gather(entries, member);
    EXPECT_EQ(member.size(), 267000u);
    entries.assign(1 << 18, 3);  // completes another member
    writer.gather(entries, member);
    EXPECT_EQ(member.size(), 267000u + 1000u + (1u << 18));
}

TEST_F(Rawlog, ReadsSeveralMembers) {
    const auto ends = writeLargeEntries(folder_ / "a.rawlog", 4);
    EXPECT_EQ(fs::file_size(folder_ / "a.rawlog"), ends.back());
    EXPECT_EQ(readLog(folder_ / "a.rawlog"), (std::pair<std::size_t, std::string>(4, "")));
    mrpt::obs::CRawlog rawlog;
    ASSERT_TRUE(rawlog.loadFromRawLogFile((folder_ / "a.rawlog").string()));
    ASSERT_EQ(rawlog.size(), 4u);
    EXPECT_EQ(rawlog.getAsObservation(3)->sensorLabel, std::string(300000, 'd'));
}

TEST_F(Rawlog, ReportsTrailingGarbage) {
    const auto ends = writeLargeEntries(folder_ / "whole.rawlog", 3);
    const std::string bytes = test::readFile(folder_ / "whole.rawlog");
    for (const std::size_t at : {ends[0], ends[0] + 1, ends[0] + 2, ends[1]}) {
        std::string damaged = bytes;
        damaged[at] = static_cast<char>(damaged[at] ^ 0x20);  // corrupts the next member's header
        const auto [read, broken] = readLog(folder_.write("damaged.rawlog", damaged));
        EXPECT_EQ(read, at < ends[1] ? 1u : 2u);
        EXPECT_THAT(broken, HasSubstr("compressed data is corrupt")) << at << broken;
    }
    const auto [read, broken] = readLog(folder_.write("longer.rawlog", bytes + "garbage"));
    EXPECT_EQ(read, 3u);
    EXPECT_NE(broken, "");
}

TEST_F(Rawlog, WritesEmptyLogAsGzip) {
    convert::RawlogWriter(folder_ / "a.rawlog", false).commit();
    mrpt::obs::CRawlog rawlog;
    EXPECT_TRUE(rawlog.loadFromRawLogFile((folder_ / "a.rawlog").string()));
    EXPECT_EQ(rawlog.size(), 0u);
}

TEST_F(Rawlog, ReportsUnknownClass) {
    mrpt::obs::CObservationRobotPose pose;
    {
        mrpt::io::CFileOutputStream stream((folder_ / "plain.rawlog").string());
        mrpt::serialization::archiveFrom(stream) << pose;
    }
    std::string bytes = test::readFile(folder_ / "plain.rawlog");
    bytes.replace(bytes.find("RobotPose"), 9, "RobotMood");
    EXPECT_THAT(readLog(folder_.write("mood.rawlog", bytes)).second,
                HasSubstr("CObservationRobotMood"));
}

TEST_F(Rawlog, RejectsOtherFiles) {
    EXPECT_THROW(RawlogReader(folder_ / "none.rawlog"), std::runtime_error);
    EXPECT_THROW(RawlogReader(folder_.write("empty.rawlog", "")), std::runtime_error);
    for (const std::string& text : {std::string("just some text, and more of it than a header"),
                                    std::string(500, '\0'), std::string(500, '\xff')}) {
        RawlogReader reader(folder_.write("text.rawlog", text));
        EXPECT_THROW(reader.next(), BrokenRecording);
    }
    const std::string garbage = "just some text, and more of it than a header";
    EXPECT_THAT(
        readLog(folder_.write("text.rawlog", garbage)).second,
        AllOf(HasSubstr("text.rawlog: is not a recording: "), HasSubstr("Supported: rawlogs")));
    const auto packed = folder_.write("log.bz2", "BZh91AY&SY");
    EXPECT_THAT(readLog(packed).second,
                HasSubstr("is not a recording: it seems to be bzip2-compressed: unpack it first"));
    // A file with a valid first entry is a recording.
    convert::Bytes entry;
    convert::serialise(comment("first"), entry);
    const std::string bytes(entry.begin(), entry.end());
    EXPECT_THAT(readLog(folder_.write("longer.rawlog", bytes + garbage)).second,
                HasSubstr("longer.rawlog: entry 1 at byte " + std::to_string(bytes.size()) +
                          " (uncompressed) cannot be read: it is not an MRPT object"));
}

/// An object that ends the process when read, like some MRPT objects on corrupt data.
class CrashingObject : public mrpt::serialization::CSerializable {
    DEFINE_SERIALIZABLE(CrashingObject, hagen::recordings)
};
IMPLEMENTS_SERIALIZABLE(CrashingObject, CSerializable, hagen::recordings)

std::uint8_t CrashingObject::serializeGetVersion() const { return 0; }
void CrashingObject::serializeTo(mrpt::serialization::CArchive&) const {}
void CrashingObject::serializeFrom(mrpt::serialization::CArchive&, std::uint8_t) { std::abort(); }

TEST_F(Rawlog, SurvivesCrashingEntry) {
    mrpt::rtti::registerClass(CLASS_ID(CrashingObject));
    convert::RawlogWriter writer(folder_ / "a.rawlog", false);
    writer.write(comment("before"));
    writer.write(CrashingObject());
    writer.write(comment("after"));
    writer.commit();
    const auto [entries, why] = readLog(folder_ / "a.rawlog");
    EXPECT_EQ(entries, 1u);
    EXPECT_THAT(why, AllOf(HasSubstr("a.rawlog: entry 1 at byte "), HasSubstr("Aborted")));
}

/// The length of a text, in the 4 bytes before it, exceeds the file size.
TEST_F(Rawlog, RejectsCountBeyondFile) {
    convert::Bytes bytes;
    convert::serialise(comment("first"), bytes);
    const std::size_t second = bytes.size();
    convert::serialise(comment(std::string(1000, 'x')), bytes);
    std::string text(bytes.begin(), bytes.end());
    const std::size_t count = text.find("xxx") - 4;
    for (const std::uint32_t wrong : {1'400'000'000u, 3'900'000'000u}) {
        text.replace(count, 4, reinterpret_cast<const char*>(&wrong), 4);
        const auto [entries, why] = readLog(folder_.write("a.rawlog", text));
        EXPECT_EQ(entries, 1u);
        EXPECT_THAT(why, HasSubstr("entry 1 at byte " + std::to_string(second)));
#ifndef __SANITIZE_ADDRESS__  // shadow memory counts towards the limit
        EXPECT_THAT(why,
                    HasSubstr("requests too much memory at byte " + std::to_string(count + 4)));
#endif
    }
}

TEST_F(Rawlog, RemovesUncommittedFile) {
    { convert::RawlogWriter(folder_ / "a.rawlog", false).write(comment("a")); }
    EXPECT_TRUE(fs::is_empty(folder_.path()));
}

TEST_F(Rawlog, KeepsReadablePartialFile) {
    convert::RawlogWriter writer(folder_ / "a.rawlog", false);
    writer.write(comment("a"));
    EXPECT_EQ(writer.keepPartial(), folder_ / "a.partial.rawlog");
    RawlogReader reader(folder_ / "a.partial.rawlog");
    EXPECT_NE(reader.next(), nullptr);
    EXPECT_EQ(reader.next(), nullptr);
}

TEST(PackedInput, AcceptsHeaderChecksumAcrossReads) {
    const std::string plain = "a member with a name and a checksum of its header";
    convert::Bytes packed;
    convert::packGzipMember({plain.begin(), plain.end()}, packed);
    std::string header(packed.begin(), packed.begin() + 10);
    header[3] = 0x08 | 0x02;  // FNAME, FHCRC (RFC 1952)
    header += "a name of the member" + std::string(1, '\0');
    const auto sum = crc32_z(0, reinterpret_cast<const Bytef*>(header.data()), header.size());
    header += {static_cast<char>(sum & 0xff), static_cast<char>(sum >> 8 & 0xff)};
    const std::string first(packed.begin(), packed.end());
    const std::string second = header + first.substr(10);
    test::TemporaryFolder folder;
    for (std::size_t before = 1; before < 40; ++before) {  // bytes before the end of a read
        const std::string padding((1 << 17) - before - first.size(), '\0');
        PackedInput input(folder.write("a.gz", first + padding + second));
        std::string read(3 * plain.size(), ' ');
        read.resize(input.Read(read.data(), read.size()));
        EXPECT_EQ(read, plain + plain) << before;
        EXPECT_EQ(input.fault(), "");
    }
}

}  // namespace
}  // namespace hagen::recordings
