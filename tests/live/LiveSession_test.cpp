#include <gmock/gmock.h>
#include <hagen/live/LiveSession.h>
#include <hagen/sensors/CaptureFile.h>

#include <deque>
#include <sstream>
#include <thread>

#include "support/CaptureWriter.h"
#include "support/LivoxPackets.h"
#include "support/OusterModes.h"
#include "support/Program.h"
#include "support/SimpleFirings.h"

namespace hagen::live {
namespace {

using sensors::velodyneModel;
using testing::AllOf;
using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

/// A source of given packets that pauses only on request.
class GivenPackets : public PacketSource {
 public:
    GivenPackets& add(const std::string& bytes, std::uint32_t from_ip = 0x0a000064) {
        Packet packet;
        packet.bytes.assign(bytes.begin(), bytes.end());
        packet.from_ip = from_ip;
        packet.to_ip = 0x0a000001;
        packet.from_port = 443;
        packet.to_port = 2368;
        packet.arrival_s = later_s_;
        packet.time_ns = 1700000000000000000 + 1330000 * static_cast<std::int64_t>(packets_.size());
        packets_.push_back(packet);
        return *this;
    }
    GivenPackets& addAll(const std::vector<std::string>& packets, std::uint32_t ip = 0x0a000064) {
        for (const std::string& packet : packets) add(packet, ip);
        return *this;
    }
    GivenPackets& pause(double seconds) {
        Packet packet;
        packet.arrival_s = seconds;
        packets_.push_back(packet);
        return *this;
    }
    /// A simulated pause before the following packets: arrival times change, but the source does
    /// not wait, so that timing does not depend on the machine's load.
    GivenPackets& later(double seconds) {
        later_s_ += seconds;
        return *this;
    }

    Next next(Packet& packet) override {
        if (packets_.empty()) return Next::End;
        packet = packets_.front();
        packets_.pop_front();
        if (packet.bytes.empty()) {
            std::this_thread::sleep_for(std::chrono::duration<double>(packet.arrival_s));
            return Next::Nothing;
        }
        packet.arrival_s = later_s_ > 0 ? start_s_ + packet.arrival_s : steadyNow_s();
        return Next::Packet;
    }
    bool isLive() const override { return is_live_; }
    /// Like a real sensor, the source does not wait for labels.
    GivenPackets& asSensor() {
        is_live_ = true;
        return *this;
    }
    std::size_t left() const { return packets_.size(); }

 private:
    std::deque<Packet> packets_;
    bool is_live_ = false;
    double later_s_ = 0;
    const double start_s_ = steadyNow_s();
};

std::vector<std::string> turnsOf(int turns, std::uint32_t first_us = 1000000,
                                 const char* name = "VLP-16", bool is_dual = false) {
    const test::SimpleScene scene = test::sceneOf({}, {{8, 3, 0.2, 6}});
    return test::turnsOf(scene, velodyneModel(name), turns, first_us, is_dual);
}

constexpr std::uint32_t kOurs = 0x0a000064, kOther = 0x0a000065;

class LiveSessionTest : public testing::Test {
 protected:
    LiveReport run(GivenPackets& packets) {
        LiveListener listener;
        listener.remark = [this](const std::string& remark) {
            (remark.rfind("receiving packets from ", 0) == 0 ? first_remark_
                                                             : remarks_.emplace_back()) = remark;
        };
        listener.sector = [this](const LabelledSector& sector) {
            if (returns_ == 0) std::this_thread::sleep_for(first_sector_takes_);
            returns_ += sector.returns.size();
        };
        return runLive(packets, options_, listener);
    }
    LiveOptions options_ = [] {
        LiveOptions options;
        options.model = "VLP-16";
        return options;
    }();
    std::vector<std::string> remarks_;
    std::string first_remark_;
    std::size_t returns_ = 0;
    std::chrono::milliseconds first_sector_takes_{0};
};

TEST_F(LiveSessionTest, CountsUnsoundBlocks) {
    const test::TemporaryFolder folder;
    options_.stats = folder / "stats.json";
    auto packets = turnsOf(1);
    for (const int block : {3, 4, 8}) packets[20][100 * block] = '\0';
    GivenPackets source;
    EXPECT_EQ(run(source.addAll(packets)).unsound_blocks, 3u);
    EXPECT_THAT(test::readFile(options_.stats), HasSubstr("\"unsound_blocks\": 3,"));
}

TEST_F(LiveSessionTest, ReportsOtherOusterMode) {
    const test::TemporaryFolder folder;
    options_.model = "";
    options_.sensor_json = folder.write("ouster.json", test::ousterJsonOf({1024, 10}));
    options_.settings.options.columns = 64;
    options_.settings.options.window_size = 2;
    options_.settings.options.principal_components = 1;
    test::TurningOuster ouster;
    GivenPackets source;
    source.addAll(ouster.turn({1024, 10})).addAll(ouster.turn({1024, 10}));
    source.addAll(ouster.turn({512, 10}));
    source.addAll(ouster.turn({1024, 10})).addAll(ouster.turn({1024, 10}));
    ++ouster.initialization;
    source.addAll(ouster.turn({1024, 10})).addAll(ouster.turn({1024, 10}));
    const LiveReport report = run(source);
    EXPECT_GE(report.uncertain, 32u + 64u);
    EXPECT_EQ(report.packets + report.uncertain, 6 * 64u + 32u);
    ASSERT_EQ(remarks_.size(), 4u);
    EXPECT_THAT(remarks_[0], HasSubstr("turns do not match the columns in "));
    EXPECT_THAT(remarks_[1], HasSubstr("turns match its metadata again"));
    EXPECT_THAT(remarks_[2], HasSubstr("the sensor restarted; dropping its packets until "));
    EXPECT_EQ(remarks_[3], remarks_[1]);
}

/// Both sensors send unusable packets: neither is silent, so neither replaces the other.
TEST_F(LiveSessionTest, SensorInOtherModeIsNotSilent) {
    const test::TemporaryFolder folder;
    options_.model = "";
    std::string json = test::ousterJsonOf({1024, 10});
    const auto serial = json.find("prod_sn");
    if (serial != std::string::npos) json.replace(serial, 7, "no_sn__");
    options_.sensor_json = folder.write("ouster.json", json);
    options_.settings.options.columns = 64;
    options_.settings.options.window_size = 2;
    options_.settings.options.principal_components = 1;
    test::TurningOuster ours, other;
    GivenPackets source;
    for (int turn = 0; turn < 3; ++turn) {
        const auto of_ours = ours.turn({512, 10}), of_other = other.turn({512, 10});
        for (std::size_t i = 0; i < of_ours.size(); ++i) {
            source.add(of_ours[i], kOurs).add(of_other[i], kOther).later(0.1 / 32);
        }
        source.later(0.4);
    }
    EXPECT_EQ(run(source).other_sensor, 3u * 32);
    EXPECT_THAT(remarks_, testing::Each(testing::Not(HasSubstr("address changed"))));
}

TEST_F(LiveSessionTest, CountsTooLateMid360Packets) {
    options_.model = "Mid-360";
    GivenPackets source;
    for (int k = 0; k < 100; ++k) {
        source.add(test::livoxPacketOfWall(k, 1000000000 + test::kLivoxPacket_ns * k));
    }
    source.add(test::livoxPacketOfWall(20, 1000000000 + test::kLivoxPacket_ns * 20 + 1));
    const LiveReport report = run(source);
    EXPECT_EQ(report.too_late, 1u);
    EXPECT_GE(report.late, report.too_late);
}

TEST_F(LiveSessionTest, CountsEachPacketOnce) {
    auto packets = turnsOf(3);
    const std::string first = packets[0];
    packets.erase(packets.begin() + 100, packets.begin() + 102);  // lost
    std::swap(packets[50], packets[51]);                          // late
    packets.insert(packets.begin() + 30, packets[29]);            // repeated
    GivenPackets source;
    source.addAll(packets);
    source.add(std::string(512, 'p'));                // a position packet
    source.add("hello").add(std::string(1206, 'x'));  // noise
    source.add(turnsOf(1, 0, "HDL-32E")[0]);          // another model
    source.add(turnsOf(1, 9000000)[0], 0x0a000065);   // another VLP-16
    const LiveReport report = run(source);
    EXPECT_EQ(report.datagrams, 228u - 2 + 1 + 5);
    EXPECT_EQ(report.packets, 226u);
    EXPECT_EQ(report.lost, 2u);
    EXPECT_EQ(report.late, 1u);
    EXPECT_EQ(report.duplicate, 1u);
    EXPECT_EQ(report.auxiliary, 1u);
    EXPECT_EQ(report.wrong_size, 2u);
    EXPECT_EQ(report.dropped, 0u);
    EXPECT_EQ(report.returns, returns_);
    EXPECT_GT(report.roi, 100u);
    EXPECT_EQ(report.latency.count() + report.sectors_cut, report.sectors);
    // The pole is 8.5 m away, 20 degrees to the left of ahead.
    const int sector = (360 - 21) / 5;
    EXPECT_NEAR(report.nearest_m[sector], 8.35, 0.3);
    EXPECT_TRUE(std::isinf(report.nearest_m[(sector + 36) % 72]));
    // A session starved of CPU time correctly reports stale data and a silent or slow sensor, and
    // may switch to the other VLP-16.
    if (report.seconds > 0.25) GTEST_SKIP() << "this machine is too slow at the moment";
    EXPECT_EQ(report.other_sensor, 2u);
    EXPECT_EQ(report.latest[sector].state, SectorDistances::State::Obstacle);
    EXPECT_EQ(first_remark_, "receiving packets from 10.0.0.100");
    EXPECT_THAT(remarks_, ElementsAre("ignoring packets of another sensor from 10.0.0.101; select "
                                      "a sensor with --from-address"));
}

/// The other sensor sends first and alone, and is silent later.
TEST_F(LiveSessionTest, UsesGivenAddressOnly) {
    options_.from_ip = kOurs;
    GivenPackets source;
    source.later(0.01).addAll(turnsOf(1), kOther).addAll(turnsOf(1, 1100000), kOurs);
    source.later(1.5).addAll(turnsOf(1, 1200000), kOther);
    const LiveReport report = run(source);
    EXPECT_EQ(report.packets, 76u);
    EXPECT_EQ(report.other_sensor, 2u * 76);
    EXPECT_EQ(first_remark_, "receiving packets from 10.0.0.100");
    EXPECT_THAT(remarks_, Contains("ignoring packets of another sensor from 10.0.0.101"));
    options_.from_ip = 0x0a000066;
    remarks_.clear();
    GivenPackets none;
    EXPECT_EQ(run(none.addAll(turnsOf(1))).packets, 0u);
    EXPECT_EQ(sensorName(options_), "a VLP-16 at 10.0.0.102");
}

TEST_F(LiveSessionTest, ReportsStartAndEndOfSilence) {
    GivenPackets source;
    auto turn = turnsOf(1);
    turn.resize(74);  // not a whole number of sectors
    source.addAll(turn).pause(1.2).add(turnsOf(1, 2400000)[0], 0x0a000066);
    const LiveReport report = run(source);
    EXPECT_EQ(report.silences, 1u);
    EXPECT_EQ(report.interruptions, 1u);
    EXPECT_EQ(report.packets, 75u);
    EXPECT_EQ(report.other_sensor, 0u);
    EXPECT_EQ(report.sectors_cut, 2u);  // at the silence, and at the end
    EXPECT_THAT(remarks_, Contains(HasSubstr("no valid packet from the sensor for 1 s")));
    EXPECT_THAT(remarks_, Contains(HasSubstr("to 10.0.0.102")));
    EXPECT_THAT(remarks_, Contains(HasSubstr("receiving packets")));
}

TEST_F(LiveSessionTest, ReportsMissingReturns) {
    GivenPackets source;
    source.addAll(turnsOf(1));
    for (std::uint32_t turn = 1; turn <= 12; ++turn) {
        for (std::string packet : turnsOf(1, 1000000 + 100000 * turn)) {
            for (std::size_t at = 0; at < 1200; ++at) {
                if (at % 100 >= 4 && (at % 100 - 4) % 3 != 2) packet[at] = 0;  // distances
            }
            source.add(packet);
        }
        source.later(0.1);
    }
    source.addAll(turnsOf(1, 1000000 + 100000 * 13));
    run(source);
    EXPECT_THAT(remarks_,
                ElementsAre(HasSubstr("no returns for 1 s"), HasSubstr("receiving returns")));
}

/// Packets before a pause are labelled even if other sensors send to the port.
TEST_F(LiveSessionTest, WarnsAboutUnmaskedAirframeOnce) {
    const test::SimpleScene scene = test::sceneOf({}, {{0.7, 0, 0.05, 3}});
    const auto& model = velodyneModel("VLP-16");
    observations::Firings firings = test::fireAt(scene, model, {0, 0, 2});
    const auto turns = [&](int number) {
        remarks_.clear();
        GivenPackets source;
        for (int turn = 0; turn < number; ++turn) {
            firings.first_time_us = 1000000 + 100000 * static_cast<std::uint32_t>(turn);
            source.addAll(test::packetsOf(model, firings)).later(0.1);
        }
        run(source);
    };
    turns(95);
    EXPECT_THAT(remarks_, IsEmpty());
    turns(140);
    EXPECT_THAT(remarks_, ElementsAre(AllOf(HasSubstr("within 1 m of the sensor for 10 s"),
                                            HasSubstr("--learn-airframe"))));
}

TEST_F(LiveSessionTest, ForeignPacketsDoNotDelayLabels) {
    GivenPackets source;
    auto turn = turnsOf(1);
    turn.resize(74);  // not a whole number of sectors
    const std::vector<std::string> others(10, turnsOf(1, 900000000)[0]);
    source.addAll(turn).addAll(others, kOther);
    source.later(0.03).addAll(others, kOther).addAll(turnsOf(1, 1140000));
    std::size_t packets = 0, cut_after = 0;
    LiveListener listener;
    listener.motion = [&](double) {
        ++packets;
        return SensorMotion();
    };
    listener.sector = [&](const LabelledSector& sector) {
        if (sector.is_cut && cut_after == 0) cut_after = packets;
    };
    runLive(source, options_, listener);
    EXPECT_EQ(cut_after, 74u + 10 + 1);
}

/// After a backlog, the newest packets are labelled first.
TEST_F(LiveSessionTest, DropsOldBacklog) {
    GivenPackets source;
    source.addAll(turnsOf(20)).pause(0.7).addAll(turnsOf(1, 4000000)).asSensor();
    first_sector_takes_ = std::chrono::milliseconds(500);
    const LiveReport report = run(source);
    EXPECT_EQ(report.packets + report.dropped, 21u * 76);
    EXPECT_GT(report.dropped, 19u * 76);
    EXPECT_GE(report.packets, 20u);  // the first sector had only 4
    EXPECT_EQ(report.silences, 0u);
    EXPECT_THAT(remarks_, testing::ElementsAre(HasSubstr("dropping packets that waited")));
}

TEST_F(LiveSessionTest, ReportsOverloadWithoutRateChange) {
    std::vector<std::vector<std::string>> turns;
    for (std::uint32_t k = 0; k < 22; ++k) turns.push_back(turnsOf(1, 1000000 + 100000 * k));
    GivenPackets source;
    source.later(0.3);  // a delay tolerated on a busy machine
    for (const auto& turn : turns) source.addAll(turn).later(0.1).pause(0.1);
    source.asSensor();
    LiveListener listener;
    std::size_t sectors = 0, dropped = 0;
    listener.remark = [&](const std::string& remark) { remarks_.push_back(remark); };
    listener.sector = [&](const auto&) {
        if (++sectors > 100) std::this_thread::sleep_for(std::chrono::milliseconds(20));
    };
    listener.status = [&](const LiveReport& report, const auto&) { dropped = report.dropped; };
    const LiveReport report = runLive(source, options_, listener);
    EXPECT_EQ(report.packets + report.dropped, 22u * 76);
    EXPECT_GT(dropped, 76u);
    EXPECT_EQ(report.rate_changes, 0u);
    EXPECT_THAT(remarks_, Contains(HasSubstr("labelling is too slow")));
}

TEST_F(LiveSessionTest, BusyProcessorIsNotSilence) {
    GivenPackets source;
    source.addAll(turnsOf(1));
    first_sector_takes_ = std::chrono::milliseconds(1200);
    const LiveReport report = run(source);
    EXPECT_EQ(report.packets, 76u);
    EXPECT_EQ(report.silences, 0u);
    EXPECT_THAT(remarks_, testing::Each(testing::Not(HasSubstr("packets"))));
}

TEST_F(LiveSessionTest, ReportsReturnModeChange) {
    GivenPackets source;
    source.addAll(turnsOf(1))
        .addAll(turnsOf(1, 1100000, "VLP-16", true))
        .addAll(turnsOf(1, 1200000));
    const LiveReport report = run(source);
    EXPECT_EQ(report.mode_changes, 2u);
    EXPECT_EQ(report.lost, 0u);
    EXPECT_THAT(remarks_, testing::ElementsAre(HasSubstr("two returns"), HasSubstr("one return")));
}

TEST_F(LiveSessionTest, EndsAfterDurationWithoutPackets) {
    GivenPackets source;
    source.pause(0.3);
    options_.duration_s = 0.05;
    const LiveReport report = run(source);
    EXPECT_EQ(report.datagrams, 0u);
    EXPECT_EQ(report.latest[0].state, SectorDistances::State::Unknown);
}

TEST_F(LiveSessionTest, CountsPacketsWaitingAtEnd) {
    const auto packets = turnsOf(40);
    GivenPackets source;
    source.addAll(packets).asSensor();
    LiveListener listener;
    listener.sector = [&](const LabelledSector& sector) { returns_ += sector.returns.size(); };
    listener.keep_going = [this] { return returns_ < 3000; };
    const LiveReport report = runLive(source, options_, listener);
    EXPECT_EQ(report.datagrams + report.dropped + source.left(), packets.size());
    EXPECT_LT(report.datagrams, packets.size());
}

/// The datagrams of a capture: payload, and other data as text.
std::vector<std::pair<std::string, std::string>> datagramsIn(const std::filesystem::path& file) {
    std::vector<std::pair<std::string, std::string>> all;
    sensors::CaptureFile capture(file);
    sensors::Datagram d;
    while (capture.next(d)) {
        all.emplace_back(std::string(reinterpret_cast<const char*>(d.bytes), d.size),
                         std::to_string(d.time_ns) + " " + sensors::ipText(d.from_ip) + ":" +
                             std::to_string(d.from_port) + " " + sensors::ipText(d.to_ip) + ":" +
                             std::to_string(d.to_port));
    }
    return all;
}

class LiveRecordingTest : public LiveSessionTest {
 protected:
    LiveRecordingTest() { options_.recording.file = folder_ / "a.pcap"; }
    test::TemporaryFolder folder_;
};

TEST_F(LiveRecordingTest, RecordsEveryDatagramAsReceived) {
    auto packets = turnsOf(2);
    packets.insert(packets.begin() + 5, "hello");
    GivenPackets source;
    const LiveReport report = run(source.addAll(packets));
    EXPECT_EQ(report.recorded.packets, packets.size());
    EXPECT_EQ(report.recorded.left_out, 0u);
    EXPECT_EQ(report.recorded.failure, "");
    EXPECT_THAT(report.recorded.files, testing::ElementsAre(folder_ / "a.pcap"));
    const auto recorded = datagramsIn(folder_ / "a.pcap");
    ASSERT_EQ(recorded.size(), packets.size());
    for (std::size_t i = 0; i < packets.size(); ++i) {
        EXPECT_EQ(recorded[i].first, packets[i]) << i;
        EXPECT_EQ(recorded[i].second, std::to_string(1700000000000000000 + 1330000 * i) +
                                          " 10.0.0.100:443 10.0.0.1:2368")
            << i;
    }
}

TEST_F(LiveRecordingTest, CountsDatagramsDroppedBySlowDisk) {
    options_.recording.queue = 1;
    GivenPackets source;
    source.addAll(turnsOf(20)).asSensor();
    const LiveReport report = run(source);
    EXPECT_EQ(report.packets + report.dropped, 20u * 76);
    EXPECT_EQ(report.recorded.packets + report.recorded.left_out, 20u * 76);
    EXPECT_GT(report.recorded.left_out, 0u);
    EXPECT_EQ(datagramsIn(folder_ / "a.pcap").size(), report.recorded.packets);
    EXPECT_THAT(remarks_, Contains(HasSubstr("the disk is too slow")));
}

TEST_F(LiveRecordingTest, ReplayWaitsForDisk) {
    options_.recording.queue = 1;
    GivenPackets source;
    EXPECT_EQ(run(source.addAll(turnsOf(20))).recorded.packets, 20u * 76);
}

TEST_F(LiveRecordingTest, KeepsExistingFiles) {
    options_.recording.file = folder_.write("a.pcap", "mine");
    GivenPackets source;
    EXPECT_THAT(test::messageOf([&] { run(source); }), HasSubstr("a.pcap exists"));
    options_.recording.file = folder_ / "b.pcap";
    folder_.write("b.tum", "mine");
    LiveListener listener;
    listener.motion = [](double) { return SensorMotion(); };
    EXPECT_THAT(test::messageOf([&] { runLive(source, options_, listener); }),
                HasSubstr("b.tum exists"));
    EXPECT_EQ(test::readFile(folder_ / "a.pcap") + test::readFile(folder_ / "b.tum"), "minemine");
    EXPECT_FALSE(std::filesystem::exists(folder_ / "b.pcap"));
}

/// The vehicle has a roll of 0.2; its sensor is mounted with a pitch of 0.3.
TEST_F(LiveRecordingTest, StampsPosesWithPacketTimes) {
    options_.settings.mount.pitch_rad = 0.3f;
    const Eigen::Quaterniond rolled(Eigen::AngleAxisd(0.2, Eigen::Vector3d::UnitX()));
    LiveListener listener;
    listener.motion = [&](double) {
        SensorMotion motion;
        motion.map_from_sensor.emplace(Eigen::Translation3d(1, 2, 3) * rolled *
                                       Eigen::AngleAxisd(0.3, Eigen::Vector3d::UnitY()));
        return motion;
    };
    GivenPackets source;
    const LiveReport report = runLive(source.addAll(turnsOf(1)), options_, listener);
    EXPECT_EQ(report.recorded.poses, 5u);  // 76 packets span 0.1 s; poses are 20 ms apart
    std::istringstream lines(test::readFile(folder_ / "a.tum"));
    std::string header;
    std::getline(lines, header);
    EXPECT_EQ(header, "# time x y z qx qy qz qw");
    std::string time;
    double x, y, z, qx, qy, qz, qw;
    std::vector<std::string> times;
    while (lines >> time >> x >> y >> z >> qx >> qy >> qz >> qw) {
        times.push_back(time);
        EXPECT_EQ(Eigen::Vector3d(x, y, z), Eigen::Vector3d(1, 2, 3));
        EXPECT_LT(Eigen::Quaterniond(qw, qx, qy, qz).angularDistance(rolled), 1e-6);
    }
    EXPECT_THAT(times, testing::ElementsAre("1700000000.000000000", "1700000000.021280000",
                                            "1700000000.042560000", "1700000000.063840000",
                                            "1700000000.085120000"));
}

TEST_F(LiveSessionTest, ReportsFailingSource) {
    class Failing : public PacketSource {
     public:
        Next next(Packet&) override { throw std::runtime_error("eth0: is gone"); }
        bool isLive() const override { return true; }
    } source;
    EXPECT_EQ(test::messageOf([&] { runLive(source, options_); }), "eth0: is gone");
}

}  // namespace
}  // namespace hagen::live
