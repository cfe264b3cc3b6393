// RawlogReader and RawlogWriter, each the other's check, and MRPT's own CRawlog theirs.
#include <gtest/gtest.h>
#include <hagen/observations/RawlogReader.h>
#include <hagen/observations/RawlogWriter.h>
#include <mrpt/obs/CObservationComment.h>
#include <mrpt/obs/CObservationRobotPose.h>
#include <mrpt/obs/CRawlog.h>

#include <fstream>
#include <stdexcept>

#include "support/Program.h"

namespace hagen {
namespace {

namespace fs = std::filesystem;
using mrpt::obs::CObservationComment;

CObservationComment comment(const std::string& text) {
    CObservationComment observation;
    observation.text = text;
    observation.timestamp = mrpt::Clock::fromDouble(1.0);
    return observation;
}

/// A log of comments "0", "1", ... with enough random text that it does not compress.
void writeLog(const fs::path& file, int entries) {
    RawlogWriter writer(file, true);
    for (int i = 0; i < entries; ++i) {
        std::string text = std::to_string(i) + " ";
        for (int k = 0; k < 300; ++k) text += static_cast<char>('a' + (i * 7919 + k * k * 31) % 26);
        writer.write(comment(text));
    }
    writer.commit();
}

TEST(Rawlog, EntriesComeBackInOrder) {
    const test::TemporaryFolder folder;
    writeLog(folder / "a.rawlog", 20);
    RawlogReader reader(folder / "a.rawlog");
    for (int i = 0; i < 20; ++i) {
        const auto entry = std::dynamic_pointer_cast<CObservationComment>(reader.next());
        ASSERT_NE(entry, nullptr);
        EXPECT_EQ(std::stoi(entry->text), i);
    }
    EXPECT_EQ(reader.next(), nullptr);
    EXPECT_EQ(reader.next(), nullptr);
    EXPECT_EQ(reader.entries(), 20u);
}

TEST(Rawlog, MrptReadsWhatWeWrite) {
    const test::TemporaryFolder folder;
    RawlogWriter writer(folder / "a.rawlog", false);
    for (int i = 0; i < 5; ++i) writer.write(mrpt::obs::CObservationRobotPose());
    writer.commit();
    mrpt::obs::CRawlog rawlog;
    ASSERT_TRUE(rawlog.loadFromRawLogFile((folder / "a.rawlog").string()));
    EXPECT_EQ(rawlog.size(), 5u);
}

TEST(Rawlog, TheSameEntriesGiveTheSameBytes) {
    const test::TemporaryFolder folder;
    writeLog(folder / "a.rawlog", 20);
    writeLog(folder / "b.rawlog", 20);
    EXPECT_EQ(test::readFile(folder / "a.rawlog"), test::readFile(folder / "b.rawlog"));
}

TEST(Rawlog, ALogCutOffAnywhereGivesItsWholeEntriesAndThenSaysWhere) {
    const test::TemporaryFolder folder;
    writeLog(folder / "whole.rawlog", 20);
    const std::string bytes = test::readFile(folder / "whole.rawlog");
    int named = 0, cuts = 0;
    for (std::size_t length = 200; length + 8 < bytes.size(); length += 97) {
        RawlogReader reader(folder.write("cut.rawlog", bytes.substr(0, length)));
        ++cuts;
        try {
            while (reader.next()) {
            }
        } catch (const BrokenRawlog& e) {
            const std::string entry = "entry " + std::to_string(reader.entries());
            EXPECT_NE(std::string(e.what()).find(entry), std::string::npos) << e.what();
            EXPECT_NE(std::string(e.what()).find("cut.rawlog"), std::string::npos);
            ++named;
        }
        EXPECT_LT(reader.entries(), 20u);
    }
    EXPECT_EQ(named, cuts);
}

TEST(Rawlog, WhatIsNoRawlogIsRefused) {
    const test::TemporaryFolder folder;
    EXPECT_THROW(RawlogReader(folder / "none.rawlog"), std::runtime_error);
    EXPECT_THROW(RawlogReader(folder.write("empty.rawlog", "")), std::runtime_error);
    for (const std::string& text : {std::string("just some text, and more of it than a header"),
                                    std::string(500, '\0'), std::string(500, '\xff')}) {
        RawlogReader reader(folder.write("text.rawlog", text));
        EXPECT_THROW(reader.next(), BrokenRawlog);
    }
}

TEST(Rawlog, AWriterThatIsGivenUpLeavesNothing) {
    const test::TemporaryFolder folder;
    { RawlogWriter(folder / "a.rawlog", false).write(comment("a")); }
    EXPECT_TRUE(fs::is_empty(folder.path()));
}

TEST(Rawlog, APartIsWholeAndReadable) {
    const test::TemporaryFolder folder;
    RawlogWriter writer(folder / "a.rawlog", false);
    writer.write(comment("a"));
    EXPECT_EQ(writer.keepPartial(), folder / "a.partial.rawlog");
    RawlogReader reader(folder / "a.partial.rawlog");
    EXPECT_NE(reader.next(), nullptr);
    EXPECT_EQ(reader.next(), nullptr);
}

}  // namespace
}  // namespace hagen
