#include <gmock/gmock.h>
#include <hagen/sensors/CaptureFile.h>
#include <zlib.h>

#include <algorithm>

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

/// An IPv6 packet from fe80::1 to ff02::1 with this content after its header.
ByteString ipv6Of(char next_header, const ByteString& content) {
    const auto address = [](unsigned first) {
        return test::big16(first) + ByteString(13, '\0') + '\x01';
    };
    return test::big32(0x60000000) + test::big16(static_cast<unsigned>(content.size())) +
           next_header + '\x40' + address(0xfe80) + address(0xff02) + content;
}

/// A pcapng file under construction, in either byte order.
struct Pcapng {
    bool is_big;
    ByteString bytes;

    ByteString number(std::uint64_t value, std::size_t size = 4) const {
        ByteString text;
        for (std::size_t i = 0; i < size; ++i) {
            text += static_cast<char>(value >> 8 * (is_big ? size - 1 - i : i) & 0xff);
        }
        return text;
    }
    Pcapng& block(std::uint32_t type, ByteString body) {
        body.resize((body.size() + 3) / 4 * 4);
        const ByteString size = number(body.size() + 12);
        bytes += number(type) + size + body + size;
        return *this;
    }
    Pcapng& section() {
        return block(0x0a0d0d0a,
                     number(0x1a2b3c4d) + number(1, 2) + number(0, 2) + ByteString(8, '\xff'));
    }
    Pcapng& interface(std::uint16_t link, std::uint32_t snap_length,
                      const ByteString& options = {}) {
        return block(1, number(link, 2) + number(0, 2) + number(snap_length) + options);
    }
    Pcapng& packet(std::uint32_t interface, std::uint64_t time, const ByteString& frame) {
        return block(6, number(interface) + number(time >> 32) + number(time & 0xffffffff) +
                            number(frame.size()) + number(frame.size()) + frame);
    }
};

ByteString gzipped(const ByteString& bytes) {
    const test::TemporaryFolder folder;
    const gzFile out = gzopen((folder / "a.gz").c_str(), "wb");
    gzwrite(out, bytes.data(), static_cast<unsigned>(bytes.size()));
    gzclose(out);
    return test::readFile(folder / "a.gz");
}

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

TEST_F(CaptureFileTest, ReadsDifferentInterfacesOfPcapng) {
    const ByteString ip = test::ipOf(sent("x"));
    for (const bool is_big : {false, true}) {
        Pcapng file{is_big, {}};
        const ByteString nanoseconds =
            file.number(9, 2) + file.number(1, 2) + ByteString("\x09\0\0\0", 4);
        const ByteString binary = file.number(9, 2) + file.number(1, 2) +
                                  ByteString("\x8a\0\0\0", 4) + file.number(14, 2) +
                                  file.number(8, 2) + file.number(1000, 8) + file.number(0);
        file.section().interface(1, 65535).interface(101, 262144, nanoseconds);
        file.interface(105, 0).interface(
            1, 0, file.number(2, 2) + file.number(3, 2) + "abc" + '\0' + binary);
        const auto timeOf = [&](const ByteString& bytes) {
            EXPECT_THAT(read(bytes), ElementsAre("x"));
            EXPECT_EQ(broken_, "");
            return last_.time_ns;
        };
        const auto with = [&](std::uint32_t interface, std::uint64_t time,
                              const ByteString& frame) {
            Pcapng one = file;
            return timeOf(one.packet(interface, time, frame).block(5, "statistics").bytes);
        };
        EXPECT_EQ(with(0, 1700000000290001, ethernet(ip)), 1700000000290001000);
        EXPECT_EQ(with(1, 1700000000290000001, ip), 1700000000290000001);
        EXPECT_EQ(with(3, 1024 * 7 + 512, ethernet(ip)), 1007500000000);
        Pcapng other = file;  // a frame of a link that is not supported
        EXPECT_EQ(timeOf(other.packet(2, 0, "wlan").packet(1, 5, ip).bytes), 5);
        EXPECT_EQ(counts_.other_traffic, 1u);
        const ByteString frame = ethernet(ip), size = file.number(frame.size());
        Pcapng simple = file, old = file;
        EXPECT_EQ(timeOf(simple.block(3, size + frame).bytes), 0);
        EXPECT_EQ(timeOf(old.block(2, file.number(3, 2) + file.number(0, 2) + file.number(0) +
                                          file.number(2048) + size + size + frame)
                             .bytes),
                  1002000000000);
        Pcapng cut{is_big, {}};
        cut.section().interface(1, 30).block(3, size + frame.substr(0, 30));
        EXPECT_TRUE(read(cut.bytes).empty());
        EXPECT_EQ(counts_.cut_frames, 1u);
        // A second section in the other byte order, with its own interfaces.
        Pcapng second{!is_big, {}};
        second.section().interface(101, 0).packet(0, 1, ip);
        EXPECT_EQ(timeOf(file.bytes + second.bytes), 1000);
        EXPECT_THAT(read(file.packet(4, 0, ip).bytes), testing::IsEmpty());
        EXPECT_THAT(broken_, HasSubstr("belongs to interface 4, which is not described"));
    }
}

TEST_F(CaptureFileTest, ReadsPcapOfOtherByteOrder) {
    const ByteString frame = ethernet(test::ipOf(sent("x")));
    const auto size = static_cast<std::uint32_t>(frame.size());
    const ByteString header =
        test::big32(0x00020004) + ByteString(8, '\0') + test::big32(65535) + test::big32(1);
    const ByteString record =
        test::big32(7) + test::big32(8) + test::big32(size) + test::big32(size);
    EXPECT_THAT(read(test::big32(0xa1b2c3d4) + header + record + frame), ElementsAre("x"));
    EXPECT_EQ(last_.time_ns, 7000008000);
    EXPECT_THAT(read(test::big32(0xa1b23c4d) + header + record + frame), ElementsAre("x"));
    EXPECT_EQ(last_.time_ns, 7000000008);
    EXPECT_THAT(read(test::big32(0xa1b2cd34) + header + record + ByteString(8, '\0') + frame),
                ElementsAre("x"));
}

TEST_F(CaptureFileTest, ReadsGzippedCaptures) {
    CaptureWriter writer;
    for (int i = 0; i < 200; ++i) writer.datagram(sent(std::to_string(i)));
    const std::vector<ByteString> plain = read(writer.bytes());
    const ByteString packed = gzipped(writer.bytes());
    EXPECT_EQ(read(packed), plain);
    EXPECT_TRUE(isCapture(test::writeBytes(folder_ / "a.gz", packed)));
    EXPECT_FALSE(isCapture(test::writeBytes(folder_ / "b.gz", gzipped("hello"))));
    EXPECT_THAT(read(gzipped(test::pcapngOf({ethernet(test::ipOf(sent("x")))}))), ElementsAre("x"));
    EXPECT_LT(read(packed.substr(0, packed.size() / 2)).size(), 200u);
    EXPECT_THAT(broken_, HasSubstr("truncated"));
}

TEST_F(CaptureFileTest, ReadsIpv6) {
    const ByteString udp = test::ipOf(sent("x")).substr(20);
    const ByteString options("\x11\0\x01\x04\0\0\0\0", 8);
    EXPECT_THAT(read(CaptureWriter()
                         .frame(ethernet(ipv6Of(17, udp), 1, 0x86dd))
                         .frame(ethernet(ipv6Of(0, options + udp), 0, 0x86dd))
                         .bytes()),
                ElementsAre("x", "x"));
    EXPECT_EQ(ipText(last_.from_ip), "fe80::1");
    EXPECT_EQ(ipText(last_.to_ip), "ff02::1");
    EXPECT_EQ(last_.to_port, 2368);
    expectBalance();
    EXPECT_THAT(read(CaptureWriter(101).frame(ipv6Of(17, udp)).bytes()), ElementsAre("x"));

    const SentDatagram whole = sent(ByteString(3000, 'x'));
    const ByteString content = test::ipOf(whole).substr(20);
    CaptureWriter writer;
    for (const std::size_t at : {2800u, 0u, 1400u}) {
        const unsigned more = at + 1400 < content.size();
        const ByteString header = test::big16(0x1100) +
                                  test::big16(static_cast<unsigned>(at) | more) +
                                  test::big32(0x12345678);
        writer.frame(ethernet(ipv6Of(44, header + content.substr(at, 1400)), 0, 0x86dd));
    }
    EXPECT_THAT(read(writer.bytes()), ElementsAre(whole.content));
    EXPECT_EQ(counts_.fragments, 3u);
    EXPECT_EQ(counts_.fragments_lost, 0u);
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
    ByteString tcp6 = ipv6Of(6, ByteString(20, '\0'));
    ByteString longer = ip;  // its header claims more bytes than the frame has
    longer[2] = '\x7f';
    ByteString udp_longer = ip;
    udp_longer[24] = '\x7f';
    ByteString no_header = ip;
    no_header[0] = '\x42';
    EXPECT_THAT(read(CaptureWriter()
                         .frame(ethernet("arp", 0, 0x0806))
                         .frame(ethernet(tcp))
                         .frame(ethernet(tcp6, 0, 0x86dd))
                         .frame("")
                         .cutFrame(ethernet(ip), 100)
                         .cutFrame(ethernet(ip), 20)
                         .frame(ethernet(longer))
                         .frame(ethernet(udp_longer))
                         .frame(ethernet(no_header))
                         .frame(ethernet("`", 0, 0x86dd))
                         .frame(ethernet(ip))
                         .bytes()),
                ElementsAre(ByteString(500, 'x')));
    EXPECT_EQ(counts_.other_traffic, 4u);
    EXPECT_EQ(counts_.cut_frames, 6u);
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
                HasSubstr("a.pcap: was captured on a link of type 105, which is not"));
    EXPECT_THAT(test::messageOf([&] { read(CaptureWriter().bytes().substr(0, 10)); }),
                HasSubstr("a.pcap: cannot be read as a capture"));
    EXPECT_THAT(test::messageOf([&] { CaptureFile(folder_ / "none.pcap"); }),
                HasSubstr("none.pcap"));
}

}  // namespace
}  // namespace hagen::sensors
