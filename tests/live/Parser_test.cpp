#include "live/mavlink/Parser.h"
#include <gmock/gmock.h>
#include "live/autopilot/Messages.h"

#include <random>

namespace hagen::mavlink {
namespace {

using Bytes = std::vector<std::uint8_t>;

Bytes attitude(std::uint8_t sequence, float roll = 0.5f, std::uint8_t system = 1) {
    Attitude message;
    message.time_boot_ms = 1000u + sequence;
    message.roll = roll;
    message.yawspeed = 0.25f;
    Frame frame = frameOf(message);
    frame.sequence = sequence;
    frame.system = system;
    frame.component = 1;
    return encode(frame, Attitude::kBytes);
}

Bytes joined(const std::vector<Bytes>& parts) {
    Bytes all;
    for (const Bytes& part : parts) all.insert(all.end(), part.begin(), part.end());
    return all;
}

class ParserTest : public testing::Test {
 protected:
    void add(const Bytes& bytes) { parser_.add(bytes.data(), bytes.size(), take_); }

    Parser parser_;
    std::vector<Frame> frames_;
    const Parser::Take take_ = [this](const Frame& frame) { frames_.push_back(frame); };
};

TEST_F(ParserTest, AcceptsStreamInAnyPieces) {
    const Bytes bytes = joined({attitude(0), attitude(1), attitude(2)});
    for (const std::uint8_t byte : bytes) add({byte});
    ASSERT_EQ(frames_.size(), 3u);
    EXPECT_EQ(frames_[2].sequence, 2);
    EXPECT_EQ(frames_[2].component, 1);
    EXPECT_EQ(messageOf<Attitude>(frames_[2])->roll, 0.5f);
    EXPECT_EQ(messageOf<Attitude>(frames_[2])->yawspeed, 0.25f);
    EXPECT_EQ(parser_.counts().messages, 3u);
    EXPECT_EQ(parser_.counts().skipped_bytes, 0u);
    EXPECT_EQ(parser_.counts().lost, 0u);
}

TEST_F(ParserTest, TruncatedFieldsAreZero) {
    add(attitude(0, 0.5f));
    add(encode(frameOf(Attitude()), Attitude::kBytes));
    ASSERT_EQ(frames_.size(), 2u);
    EXPECT_EQ(messageOf<Attitude>(frames_[1])->roll, 0);
}

TEST_F(ParserTest, WrongByteDropsOneMessage) {
    const Bytes sound = attitude(1);
    for (std::size_t i = 0; i < sound.size(); ++i) {
        for (const int flip : {0x01, 0x80, 0xff}) {
            Parser parser;
            std::size_t taken = 0;
            Bytes broken = sound;
            broken[i] = static_cast<std::uint8_t>(broken[i] ^ flip);
            const Bytes bytes = joined({attitude(0), broken, attitude(2), attitude(3)});
            const auto take = [&](const Frame&) { ++taken; };
            parser.add(bytes.data(), bytes.size(), take);
            parser.end(take);
            EXPECT_EQ(taken, 3u) << "byte " << i;
        }
    }
}

TEST_F(ParserTest, SkipsGarbage) {
    std::mt19937 random(1);
    for (int trial = 0; trial < 300; ++trial) {
        Bytes bytes;
        std::size_t sent = 0;
        for (int k = 0; k < 8; ++k) {
            const std::size_t noise = random() % 40;
            for (std::size_t i = 0; i < noise; ++i) {
                // Makes many noise bytes look like the start of a message.
                bytes.push_back(static_cast<std::uint8_t>(random() % 4 == 0 ? 0xfd : random()));
            }
            const Bytes message = attitude(static_cast<std::uint8_t>(k));
            bytes.insert(bytes.end(), message.begin(), message.end());
            ++sent;
        }
        Parser parser;
        std::size_t taken = 0;
        const auto take = [&](const Frame& frame) {
            ++taken;
            EXPECT_EQ(messageOf<Attitude>(frame)->roll, 0.5f);
        };
        for (std::size_t at = 0; at < bytes.size();) {
            const std::size_t size = std::min<std::size_t>(1 + random() % 90, bytes.size() - at);
            parser.add(&bytes[at], size, take);
            at += size;
        }
        parser.end(take);
        EXPECT_EQ(taken, sent);
        EXPECT_EQ(parser.counts().messages, sent);
        EXPECT_EQ(parser.counts().skipped_bytes, bytes.size() - sent * attitude(0).size());
    }
}

TEST_F(ParserTest, RejectsRandomBytes) {
    std::mt19937 random(2);
    Bytes bytes(200000);
    for (auto& byte : bytes) byte = static_cast<std::uint8_t>(random());
    add(bytes);
    // By chance, 1 in 65536 random sequences has a correct checksum.
    EXPECT_LE(frames_.size(), 1u);
    add(attitude(0));
    parser_.end(take_);
    EXPECT_GE(frames_.size(), 1u);
    EXPECT_EQ(messageOf<Attitude>(frames_.back())->roll, 0.5f);
}

TEST_F(ParserTest, SkipsSignature) {
    Bytes bytes = attitude(0);
    bytes[2] = 1;  // signed, which changes the checksum
    bytes.resize(bytes.size() - 2);
    const std::uint8_t extra = Attitude::kCrcExtra;
    const std::uint16_t crc = checksum(&extra, 1, checksum(&bytes[1], bytes.size() - 1));
    bytes.push_back(static_cast<std::uint8_t>(crc));
    bytes.push_back(static_cast<std::uint8_t>(crc >> 8));
    for (int i = 0; i < 13; ++i) bytes.push_back(0xfd);
    add(joined({bytes, attitude(1)}));
    ASSERT_EQ(frames_.size(), 2u);
    EXPECT_TRUE(frames_[0].is_signed);
    EXPECT_FALSE(frames_[1].is_signed);
    EXPECT_EQ(parser_.counts().is_signed, 1u);
    EXPECT_EQ(parser_.counts().skipped_bytes, 0u);
}

TEST_F(ParserTest, SkipsUnknownFormat) {
    Bytes bytes = attitude(0);
    bytes[2] = 2;
    const std::uint8_t extra = Attitude::kCrcExtra;
    const std::uint16_t crc = checksum(&extra, 1, checksum(&bytes[1], bytes.size() - 3));
    bytes[bytes.size() - 2] = static_cast<std::uint8_t>(crc);
    bytes[bytes.size() - 1] = static_cast<std::uint8_t>(crc >> 8);
    add(joined({bytes, attitude(1)}));
    EXPECT_EQ(frames_.size(), 1u);
    EXPECT_EQ(parser_.counts().incompatible, 1u);
}

/// Encoded by node-mavlink: HEARTBEAT and ATTITUDE of system 2.
const Bytes kMavlink1 = {0xfe, 0x09, 0x00, 0x02, 0x01, 0x00, 0x00, 0x00, 0x00, 0x00, 0x02,
                         0x0c, 0x51, 0x03, 0x03, 0x73, 0x35, 0xfe, 0x1c, 0x01, 0x02, 0x01,
                         0x1e, 0xe8, 0x03, 0x00, 0x00, 0x00, 0x00, 0x00, 0x3f, 0x00, 0x00,
                         0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00,
                         0x00, 0x00, 0x00, 0x00, 0x00, 0x80, 0x3e, 0x7f, 0xf2};

TEST_F(ParserTest, ReadsMavlink1) {
    for (const std::uint8_t byte : joined({kMavlink1, attitude(2, 0.5f, 2)})) add({byte});
    ASSERT_EQ(frames_.size(), 3u);
    EXPECT_EQ(frames_[0].id, Heartbeat::kId);
    EXPECT_EQ(frames_[1].version, 1);
    EXPECT_EQ(frames_[1].system, 2);
    EXPECT_EQ(messageOf<Attitude>(frames_[1])->roll, 0.5f);
    EXPECT_EQ(messageOf<Attitude>(frames_[1])->yawspeed, 0.25f);
    EXPECT_EQ(frames_[2].version, 2);
    EXPECT_EQ(parser_.counts().version_1, 2u);
    EXPECT_EQ(parser_.counts().skipped_bytes + parser_.counts().lost, 0u);
}

TEST_F(ParserTest, CountsLossesPerComponent) {
    add(joined({attitude(250), attitude(3, 0, 2), attitude(254), attitude(4, 0, 2), attitude(1)}));
    EXPECT_EQ(parser_.counts().lost, 3u + 2u);
}

TEST_F(ParserTest, DatagramEndsMessage) {
    Bytes cut = attitude(0);
    cut.pop_back();
    add(cut);
    parser_.end(take_);
    EXPECT_EQ(frames_.size(), 0u);
    EXPECT_EQ(parser_.counts().skipped_bytes, cut.size());
    add(attitude(1));
    EXPECT_EQ(frames_.size(), 1u);
}

}  // namespace
}  // namespace hagen::mavlink
