#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <hagen/sensors/CaptureFile.h>

#include <algorithm>
#include <string>
#include <vector>

#include "support/CaptureWriter.h"
#include "support/Program.h"
#include "support/Random.h"

namespace hagen::sensors {
namespace {

using test::ByteString;
using test::CaptureWriter;
using test::ethernet;
using test::SentDatagram;
using testing::ElementsAre;
using testing::HasSubstr;

class CaptureFileTest : public testing::Test {
 protected:
    /// The payloads of all datagrams in these bytes; updates the counters.
    std::vector<ByteString> read(const ByteString& bytes) {
        CaptureFile capture(test::writeBytes(folder_ / "a.pcap", bytes));
        std::vector<ByteString> contents;
        Datagram datagram;
        broken_ = test::messageOf<BrokenCapture>([&] {
            while (capture.next(datagram)) {
                contents.emplace_back(reinterpret_cast<const char*>(datagram.bytes), datagram.size);
                last_ = datagram;
            }
        });
        counts_ = capture.counts();
        return contents;
    }
    /// Expects that every frame is counted once.
    void expectBalance() const {
        EXPECT_EQ(counts_.frames, counts_.datagrams + counts_.fragments + counts_.other_traffic +
                                      counts_.cut_frames);
    }

    test::TemporaryFolder folder_;
    Datagram last_;
    FrameCounts counts_;
    std::string broken_;
};

SentDatagram sent(const ByteString& content) { return {content}; }

TEST_F(CaptureFileTest, CheckInterruptsSearch) {
    CaptureWriter writer;
    const ByteString arp = ethernet(ByteString(28, 'a'), 0, 0x0806);
    for (int i = 0; i < 5000; ++i) writer.frame(arp);
    CaptureFile capture(writer.write(folder_ / "arp.pcap"));
    struct Stop {};
    int checks = 0;
    capture.checkWhileReading([&] {
        if (++checks == 3) throw Stop();
    });
    Datagram datagram;
    EXPECT_THROW(capture.next(datagram), Stop);
    EXPECT_EQ(capture.counts().frames, 3 * CaptureFile::kFramesPerCheck);
    // Reading continues at the same position.
    EXPECT_FALSE(capture.next(datagram));
    EXPECT_EQ(capture.counts().other_traffic, 5000u);
}

TEST_F(CaptureFileTest, ReadsDatagramsInOrder) {
    SentDatagram second = sent("two");
    second.time_s = 1700000001.25;
    second.from_ip = 0x01020304;
    second.to_port = 7502;
    EXPECT_THAT(read(CaptureWriter().datagram(sent("one")).datagram(second).bytes()),
                ElementsAre("one", "two"));
    EXPECT_EQ(last_.time_ns, 1700000001250000000);
    EXPECT_EQ(ipText(last_.from_ip), "1.2.3.4");
    EXPECT_EQ(last_.to_port, 7502);
    EXPECT_EQ(broken_, "");
    expectBalance();
}

TEST_F(CaptureFileTest, ReadsAllFormatsAndLinks) {
    const ByteString ip = test::ipOf(sent("x"));
    EXPECT_THAT(read(test::pcapngOf({ethernet(ip), ethernet(ip)})), ElementsAre("x", "x"));
    EXPECT_THAT(read(CaptureWriter(101).frame(ip).bytes()), ElementsAre("x"));
    const ByteString any = ByteString(14, '\0') + test::big16(0x0800) + ip;
    EXPECT_THAT(read(CaptureWriter(113).frame(any).bytes()), ElementsAre("x"));
    const ByteString any2 = test::big16(0x0800) + ByteString(18, '\0') + ip;
    EXPECT_THAT(read(CaptureWriter(276).frame(any2).bytes()), ElementsAre("x"));
    EXPECT_THAT(read(CaptureWriter(0).frame(ByteString("\x02\0\0\0", 4) + ip).bytes()),
                ElementsAre("x"));
    // The time stamps are in nanoseconds instead of microseconds.
    ByteString nanoseconds = CaptureWriter().frame(ethernet(ip), 1700000000.000123).bytes();
    nanoseconds.replace(0, 4, test::little32(0xa1b23c4d));
    EXPECT_THAT(read(nanoseconds), ElementsAre("x"));
    EXPECT_EQ(last_.time_ns, 1700000000000000123);
}

TEST_F(CaptureFileTest, ReadsVlanTags) {
    const ByteString ip = test::ipOf(sent("x"));
    EXPECT_THAT(read(CaptureWriter()
                         .frame(ethernet(ip, 1))
                         .frame(ethernet(ip, 2))
                         .frame(ethernet(ip))
                         .bytes()),
                ElementsAre("x", "x", "x"));
    EXPECT_EQ(counts_.tagged, 2u);
    expectBalance();
}

TEST_F(CaptureFileTest, ReassemblesFragmentsInAnyOrder) {
    test::Random random(1);
    ByteString content;
    for (int i = 0; i < 24896; ++i) content += static_cast<char>(random.whole(0, 255));
    std::vector<ByteString> all;
    for (std::uint16_t id = 1; id <= 3; ++id) {  // three datagrams, interleaved
        SentDatagram datagram = sent(content + static_cast<char>(id));
        datagram.id = id;
        for (const ByteString& ip : test::fragmentsOf(datagram, 1480)) all.push_back(ip);
    }
    for (std::size_t i = all.size() - 1; i > 0; --i) {
        std::swap(all[i], all[static_cast<std::size_t>(random.whole(0, static_cast<int>(i)))]);
    }
    CaptureWriter writer;
    for (const ByteString& ip : all) writer.frame(ethernet(ip));
    auto contents = read(writer.bytes());
    std::sort(contents.begin(), contents.end());
    EXPECT_THAT(contents, ElementsAre(content + '\x01', content + '\x02', content + '\x03'));
    EXPECT_EQ(counts_.fragments, all.size());
    EXPECT_EQ(counts_.fragments_lost, 0u);
}

TEST_F(CaptureFileTest, CountsIncompleteFragments) {
    SentDatagram first = sent(ByteString(4000, 'a')), second = sent(ByteString(100, 'b'));
    first.id = 1;
    auto fragments = test::fragmentsOf(first, 1480);
    ASSERT_EQ(fragments.size(), 3u);
    EXPECT_THAT(read(CaptureWriter()
                         .frame(ethernet(fragments[0]))
                         .frame(ethernet(fragments[2]))
                         .datagram(second)
                         .bytes()),
                ElementsAre(second.content));
    EXPECT_EQ(counts_.fragments, 2u);
    EXPECT_EQ(counts_.fragments_lost, 2u);
}

TEST_F(CaptureFileTest, LimitsOpenDatagrams) {
    CaptureWriter writer;
    for (std::uint16_t id = 0; id < 1000; ++id) {
        SentDatagram datagram = sent(ByteString(100, 'a'));
        datagram.id = id;
        writer.frame(ethernet(test::fragmentsOf(datagram, 64)[0]));
    }
    EXPECT_TRUE(read(writer.bytes()).empty());
    EXPECT_EQ(counts_.fragments_lost, 1000u);
}

TEST_F(CaptureFileTest, CountsOtherTrafficAndCutFrames) {
    const ByteString ip = test::ipOf(sent(ByteString(500, 'x')));
    ByteString tcp = ip;
    tcp[9] = '\x06';
    ByteString longer = ip;  // its header claims more bytes than the frame has
    longer[2] = '\x7f';
    ByteString udp_longer = ip;
    udp_longer[24] = '\x7f';
    ByteString no_header = ip;
    no_header[0] = '\x42';
    EXPECT_THAT(read(CaptureWriter()
                         .frame(ethernet("arp", 0, 0x0806))
                         .frame(ethernet(tcp))
                         .frame(ethernet("ipv6", 0, 0x86dd))
                         .frame("")
                         .cutFrame(ethernet(ip), 100)
                         .cutFrame(ethernet(ip), 20)
                         .frame(ethernet(longer))
                         .frame(ethernet(udp_longer))
                         .frame(ethernet(no_header))
                         .frame(ethernet(ip))
                         .bytes()),
                ElementsAre(ByteString(500, 'x')));
    EXPECT_EQ(counts_.other_traffic, 4u);
    EXPECT_EQ(counts_.cut_frames, 5u);
    expectBalance();
}

TEST_F(CaptureFileTest, ReportsTruncationPosition) {
    CaptureWriter writer;
    for (int i = 0; i < 5; ++i) writer.datagram(sent(ByteString(60, 'x')));
    std::vector<ByteString> frames(5, ethernet(test::ipOf(sent(ByteString(60, 'x')))));
    for (const ByteString& whole : {writer.bytes(), test::pcapngOf(frames)}) {
        std::size_t broken = 0;
        for (std::size_t size = 0; size < whole.size(); size += 5) {
            std::size_t datagrams = 0;
            const std::string why = test::messageOf([&] {
                datagrams = read(whole.substr(0, size)).size();
                if (!broken_.empty()) throw std::runtime_error(broken_);
            });
            broken += !why.empty();
            EXPECT_LE(datagrams, 5u);
            if (why.empty()) continue;
            EXPECT_THAT(why, HasSubstr("a.pcap: ")) << size;
            if (size > 300) {
                EXPECT_THAT(why, HasSubstr("frame " + std::to_string(datagrams) + " at byte "));
            }
        }
        EXPECT_GT(broken, 100u);  // at every position except between two frames
        EXPECT_EQ(read(whole).size(), 5u);
    }
}

TEST_F(CaptureFileTest, SurvivesCorruptData) {
    test::Random random(2);
    SentDatagram datagram = sent(ByteString(3000, 'x'));
    CaptureWriter writer;
    for (const ByteString& ip : test::fragmentsOf(datagram, 1480)) writer.frame(ethernet(ip, 1));
    writer.datagram(datagram);
    for (int round = 0; round < 200; ++round) {
        ByteString bytes = writer.bytes();
        for (int i = random.whole(1, 8); i > 0; --i) {
            // Mostly corrupts headers.
            const int at = random.chance(0.8) ? random.whole(24, 24 + 16 + 60)
                                              : random.whole(0, static_cast<int>(bytes.size()) - 1);
            bytes[static_cast<std::size_t>(at)] = static_cast<char>(random.whole(0, 255));
        }
        test::messageOf([&] { read(bytes); });
    }
}

TEST_F(CaptureFileTest, DetectsCaptureByContent) {
    const ByteString pcap = CaptureWriter().bytes();
    EXPECT_TRUE(isCapture(test::writeBytes(folder_ / "flight.rawlog", pcap)));
    EXPECT_TRUE(isCapture(test::writeBytes(folder_ / "b", test::pcapngOf({}))));
    EXPECT_FALSE(isCapture(test::writeBytes(folder_ / "c.pcap", "hello")));
    EXPECT_FALSE(isCapture(test::writeBytes(folder_ / "d.pcap", "")));
    EXPECT_FALSE(isCapture(folder_ / "none.pcap"));
}

TEST_F(CaptureFileTest, ReportsUnreadableFile) {
    EXPECT_THAT(test::messageOf([&] { read(CaptureWriter(105).bytes()); }),
                HasSubstr("a.pcap: was captured on a link of type IEEE802_11, which is not"));
    EXPECT_THAT(test::messageOf([&] { read(CaptureWriter().bytes().substr(0, 10)); }),
                HasSubstr("a.pcap: cannot be read as a capture"));
    EXPECT_THAT(test::messageOf([&] { CaptureFile(folder_ / "none.pcap"); }),
                HasSubstr("none.pcap"));
}

}  // namespace
}  // namespace hagen::sensors
