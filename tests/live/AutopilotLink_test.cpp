#include "live/autopilot/AutopilotLink.h"
#include <gmock/gmock.h>
#include <hagen/scan/Angle.h>
#include "live/mavlink/Parser.h"

#include <algorithm>
#include <mutex>
#include <new>
#include <thread>

#include "live/Vehicle.h"
#include "support/LocalUdp.h"

namespace hagen::live {
namespace {

using testing::Contains;
using testing::HasSubstr;
constexpr auto now_s = test::steadyNow_s;

/// An autopilot, simulated by a local UDP socket.
class Autopilot {
 public:
    mavlink::PeerAddress address() const {
        mavlink::PeerAddress address;
        address.host = "127.0.0.1";
        address.port = socket_.port();
        return address;
    }
    /// The next message, or id 0xffffff after 5 s without a message.
    mavlink::Frame receive() {
        mavlink::Frame frame;
        frame.id = 0xffffff;
        const auto datagram = socket_.receive();
        if (!datagram) return frame;
        from_ = datagram->from;
        parser_.add(reinterpret_cast<const std::uint8_t*>(datagram->bytes.data()),
                    datagram->bytes.size(), [&](const mavlink::Frame& each) { frame = each; });
        EXPECT_EQ(parser_.counts().skipped_bytes, 0u);
        EXPECT_EQ(parser_.counts().lost, 0u);
        EXPECT_EQ(frame.system, 1);
        EXPECT_EQ(frame.component, 196);
        return frame;
    }
    /// The first of the next `most` messages for which `is` is true.
    template <class Message, class Is>
    std::optional<Message> receiveUntil(const Is& is, int max = 400) {
        for (int i = 0; i < max; ++i) {
            const auto message = mavlink::messageOf<Message>(receive());
            if (message && is(*message)) return message;
        }
        return std::nullopt;
    }
    void send(mavlink::Frame frame, std::uint8_t system = 1, std::uint8_t component = 1) {
        frame.sequence = sequence_++;
        frame.system = system;
        frame.component = component;
        const auto bytes = mavlink::encode(frame, 28);
        sendRaw({bytes.begin(), bytes.end()});
    }
    void sendRaw(const std::string& bytes) const { socket_.send(bytes, from_); }

 private:
    test::LocalUdp socket_{std::chrono::seconds(5)};
    std::uint8_t sequence_ = 0;
    sockaddr_in from_{};
    mavlink::Parser parser_;
};

bool isAllUnknown(const mavlink::ObstacleDistance& message) {
    return std::all_of(message.distances.begin(), message.distances.end(),
                       [](std::uint16_t each) { return each == 65535; });
}

class AutopilotLinkTest : public testing::Test {
 protected:
    AutopilotLinkTest() {
        settings_.peer = autopilot_.address();
        open();
    }
    void open() {
        link_ = std::make_unique<AutopilotLink>(settings_, [this](const std::string& remark) {
            const std::lock_guard lock(mutex_);
            remarks_.push_back(remark);
        });
    }
    /// Adds a turn with one return straight ahead, and others to the left in steps of 1 m.
    void takeTurn(int returns = 1) {
        Scan scan;
        for (int i = 0; i < returns; ++i) {
            const float range_m = 6.0f + static_cast<float>(i),
                        left_rad = 0.7f * static_cast<float>(i);
            scan.x_m.push_back(range_m * std::cos(left_rad));
            scan.y_m.push_back(range_m * std::sin(left_rad));
            scan.z_m.push_back(-0.5f);
        }
        SegmentationResult result;
        const double time_s = now_s();
        link_->take({scan, std::vector<Label>(scan.size(), Label::Roi),
                     Sweep{turned_rad_, turned_rad_ + 2 * kPi}, time_s - 0.001, time_s, true, false,
                     false, result});
        turned_rad_ += 2 * kPi;
    }
    std::size_t count(const std::string& name) const {
        for (const auto& [each, number] : link_->counts()) {
            if (each == name) return number;
        }
        ADD_FAILURE() << "missing count " << name;
        return 0;
    }
    std::vector<std::string> remarks() {
        const std::lock_guard lock(mutex_);
        return remarks_;
    }

    Autopilot autopilot_;
    AutopilotLink::Settings settings_;
    const SensorModel sensor_ = sensorModel("VLP-16");
    double turned_rad_ = 0;
    std::mutex mutex_;
    std::vector<std::string> remarks_;
    std::unique_ptr<AutopilotLink> link_;  // its thread uses the members above
};

TEST_F(AutopilotLinkTest, SendsUnknownBeforeLabels) {
    link_->begin(sensor_, {20, 0});
    const auto distance =
        autopilot_.receiveUntil<mavlink::ObstacleDistance>([](const auto&) { return true; });
    ASSERT_TRUE(distance);
    EXPECT_TRUE(isAllUnknown(*distance));
    const auto heartbeat = mavlink::messageOf<mavlink::Heartbeat>(autopilot_.receive());
    ASSERT_TRUE(heartbeat);
    EXPECT_EQ(heartbeat->system_status, mavlink::kStateBoot);
}

TEST_F(AutopilotLinkTest, ReportsStalledLabelling) {
    link_->begin(sensor_, {20, 0});
    takeTurn();
    const auto seen = autopilot_.receiveUntil<mavlink::ObstacleDistance>(
        [](const auto& m) { return !isAllUnknown(m); });
    ASSERT_TRUE(seen);
    EXPECT_EQ(seen->distances[0], 600);
    EXPECT_EQ(seen->distances[36], 2001);
    const auto third =
        autopilot_.receiveUntil<mavlink::ObstacleDistance3d>([](const auto&) { return true; });
    ASSERT_TRUE(third);
    EXPECT_NEAR(third->x, 6, 1e-5);
    EXPECT_NEAR(third->z, 0.5, 1e-5);
    // Labelling stops.
    ASSERT_TRUE(autopilot_.receiveUntil<mavlink::ObstacleDistance>(isAllUnknown));
    ASSERT_TRUE(autopilot_.receiveUntil<mavlink::Heartbeat>(
        [](const auto& m) { return m.system_status == mavlink::kStateCritical; }));
    EXPECT_GE(count("stalls"), 1u);
    EXPECT_THAT(remarks(), Contains(HasSubstr("sending all directions as unknown")));
    takeTurn();
    ASSERT_TRUE(autopilot_.receiveUntil<mavlink::ObstacleDistance>(
        [](const auto& m) { return m.distances[0] == 600 && m.distances[36] == 2001; }));
    EXPECT_THAT(remarks(), Contains(HasSubstr("sending directions again")));
}

/// A remark that throws std::bad_alloc represents every step that could.
TEST_F(AutopilotLinkTest, SurvivesOutOfMemory) {
    Autopilot autopilot;
    settings_.peer = autopilot.address();
    link_ = std::make_unique<AutopilotLink>(settings_,
                                            [](const std::string&) { throw std::bad_alloc(); });
    link_->begin(sensor_, {20, 0});
    takeTurn();
    ASSERT_TRUE(autopilot.receiveUntil<mavlink::ObstacleDistance>(
        [](const auto& m) { return !isAllUnknown(m); }));
    // Without labels, the state becomes critical.
    ASSERT_TRUE(autopilot.receiveUntil<mavlink::Heartbeat>(
        [](const auto& m) { return m.system_status == mavlink::kStateCritical; }));
    EXPECT_EQ(count("out_of_memory"), 1u);
}

TEST_F(AutopilotLinkTest, SendsFiveNearestObstacles) {
    link_->begin(sensor_, {20, 0});
    takeTurn(8);
    ASSERT_TRUE(autopilot_.receiveUntil<mavlink::ObstacleDistance>(
        [](const auto& m) { return !isAllUnknown(m); }));
    std::vector<float> ranges_m;
    for (int i = 0; i < 40; ++i) {
        const auto message = mavlink::messageOf<mavlink::ObstacleDistance3d>(autopilot_.receive());
        if (message) ranges_m.push_back(std::hypot(message->x, message->y));
        if (!message && !ranges_m.empty()) break;
    }
    std::sort(ranges_m.begin(), ranges_m.end());
    ASSERT_EQ(ranges_m.size(), 5u);
    for (std::size_t i = 0; i < 5; ++i) {
        EXPECT_NEAR(ranges_m[i], 6.0f + static_cast<float>(i), 1e-3);
    }
}

TEST_F(AutopilotLinkTest, LateSectorIsNotFree) {
    link_->begin(sensor_, {20, 0});
    Scan scan;
    SegmentationResult result;
    const double time_s = now_s() - 0.4;  // arrival of the sector's packets
    link_->take({scan, {}, Sweep{0, 2 * kPi}, time_s, time_s, true, false, false, result});
    for (int i = 0; i < 5; ++i) {
        const auto message =
            autopilot_.receiveUntil<mavlink::ObstacleDistance>([](const auto&) { return true; });
        EXPECT_TRUE(isAllUnknown(*message));
    }
}

TEST_F(AutopilotLinkTest, SendsAtConfiguredRates) {
    link_->begin(sensor_, {20, 0});
    std::thread labels([&] {
        for (int i = 0; i < 30; ++i) {
            takeTurn();
            std::this_thread::sleep_for(std::chrono::milliseconds(100));
        }
    });
    const auto any = [](const auto&) { return true; };
    ASSERT_TRUE(autopilot_.receiveUntil<mavlink::Heartbeat>(any));
    std::map<std::uint32_t, int> messages;
    for (;;) {
        const std::uint32_t id = autopilot_.receive().id;
        if (id == mavlink::Heartbeat::kId || id == 0xffffff) break;
        ++messages[id];
    }
    labels.join();
    EXPECT_EQ(messages[mavlink::ObstacleDistance::kId], 20);
    // At most one obstacle per period; none if this process was delayed.
    EXPECT_LE(messages[mavlink::ObstacleDistance3d::kId], 10);
    EXPECT_GT(messages[mavlink::ObstacleDistance3d::kId], 2);
    EXPECT_EQ(messages[mavlink::DistanceSensor::kId], 0);  // no ground
}

TEST_F(AutopilotLinkTest, SensorMovesWithVehicle) {
    link_->begin(sensor_, {20, 0});
    autopilot_.receive();
    Vehicle vehicle;
    vehicle.roll_rad = 0.2;
    vehicle.pitch_rad = 0.1;
    vehicle.yaw_rad = 1;
    vehicle.ned_m = {10, 20, -5};
    EXPECT_FALSE(link_->motionAt(now_s()).attitude);
    autopilot_.send(vehicle.attitude(100), 2);     // another vehicle
    autopilot_.send(vehicle.attitude(100), 1, 9);  // another component of our vehicle
    autopilot_.sendRaw("noise");
    autopilot_.send(mavlink::frameOf(mavlink::Heartbeat()));
    autopilot_.send(vehicle.attitude(100));
    autopilot_.send(vehicle.place(100));
    for (int i = 0; i < 200 && count("position") == 0; ++i) autopilot_.receive();
    const auto motion = link_->motionAt(now_s());
    ASSERT_TRUE(motion.attitude);
    EXPECT_NEAR(motion.attitude->roll_rad, 0.2, 1e-5);
    EXPECT_NEAR(motion.attitude->pitch_rad, -0.1, 1e-5);  // nose down is positive here
    ASSERT_TRUE(motion.map_from_sensor);
    EXPECT_TRUE(motion.map_from_sensor->translation().isApprox(Eigen::Vector3d(10, -20, 5)));
    EXPECT_EQ(count("attitude"), 1u);
    EXPECT_EQ(count("other_systems"), 2u);
    EXPECT_EQ(count("other_messages"), 1u);
    EXPECT_EQ(count("skipped_bytes"), 5u);
    const auto is_told = Contains(HasSubstr("receiving the attitude of vehicle 1"));
    for (int i = 0; i < 20 && !testing::Value(remarks(), is_told); ++i) autopilot_.receive();
    EXPECT_THAT(remarks(), is_told);
    // Without messages, attitude and pose become unknown.
    for (int i = 0; i < 100 && link_->motionAt(now_s()).attitude; ++i) autopilot_.receive();
    EXPECT_FALSE(link_->motionAt(now_s()).attitude);
    EXPECT_FALSE(link_->motionAt(now_s()).map_from_sensor);
}

/// The MAVLink 1 message is a HEARTBEAT of system 2, encoded by node-mavlink.
TEST_F(AutopilotLinkTest, ReportsWhyAttitudeIsUnknown) {
    const std::string port = std::to_string(settings_.peer.port);
    settings_.peer.local_port = test::freePort();
    const auto to = test::localAddress(settings_.peer.local_port);
    open();
    const auto waitForRemarks = [&](std::size_t number) {
        for (int i = 0; i < 400 && remarks().size() < number; ++i) autopilot_.receive();
        ASSERT_EQ(remarks().size(), number);
    };
    link_->begin(sensor_, {20, 0});
    waitForRemarks(1);
    const std::string begin =
        "MAVLink: no attitude from vehicle 1, scans are not levelled; received from 127.0.0.1:" +
        port + ": ";
    EXPECT_EQ(remarks()[0], begin + "nothing");
    autopilot_.sendRaw({"\xfe\x09\0\x02\x01\0\0\0\0\0\x02\x0c\x51\x03\x03\x73\x35", 17});
    autopilot_.send(Vehicle().attitude(100), 3);
    autopilot_.send(mavlink::frameOf(mavlink::Heartbeat()), 255, 190);
    const test::LocalUdp stranger;
    stranger.send(std::string("x"), to);
    waitForRemarks(2);
    const std::string other = "127.0.0.1:" + std::to_string(stranger.port());
    EXPECT_EQ(remarks()[1],
              begin +
                  "system 2: MAVLink 1, no ATTITUDE, HEARTBEAT [set --mavlink-system 2, "
                  "SERIALn_PROTOCOL = 2 (PX4: MAV_PROTO_VER = 2), SRn_EXTRA1 = 50 (PX4: "
                  "MAV_n_MODE = Onboard)]; system 3: MAVLink 2, ATTITUDE, no HEARTBEAT [set "
                  "--mavlink-system 3]; system 255, component 190: MAVLink 2, no ATTITUDE, "
                  "HEARTBEAT; ignored from " +
                  other + " [set --mavlink udp:" + other + ":" +
                  std::to_string(ntohs(to.sin_port)) + "]");
    EXPECT_EQ(count("mavlink_1") + count("other_addresses"), 2u);
    EXPECT_EQ(count("attitude"), 0u);
    autopilot_.send(Vehicle().attitude(100));
    waitForRemarks(3);
    EXPECT_EQ(remarks()[2], "MAVLink: receiving the attitude of vehicle 1");
}

/// With this many obstacles, a period takes too long.
TEST_F(AutopilotLinkTest, ReadsMessagesWhenLate) {
    link_->begin(sensor_, {20, 0});
    autopilot_.receive();
    mavlink::Attitude attitude{};
    const double start_s = now_s();
    for (std::size_t sent = 0; sent < 100; ++sent) {
        if (sent % 20 == 0) takeTurn(1000000);
        attitude.time_boot_ms = static_cast<std::uint32_t>(1e3 * (now_s() - start_s));
        autopilot_.send(mavlink::frameOf(attitude));
        std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    const double end_s = now_s() + 2;
    while (count("attitude") < 90 && now_s() < end_s) {
        std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    EXPECT_GE(count("attitude"), 90u);
}

TEST_F(AutopilotLinkTest, LastMessageIsUnknown) {
    link_->begin(sensor_, {20, 0});
    takeTurn();
    autopilot_.receiveUntil<mavlink::ObstacleDistance>(
        [](const auto& m) { return !isAllUnknown(m); });
    link_->stop();
    const std::size_t sent = count("obstacle_distance");
    ASSERT_TRUE(autopilot_.receiveUntil<mavlink::ObstacleDistance>(isAllUnknown));
    EXPECT_EQ(count("obstacle_distance"), sent);  // no more messages
}

TEST_F(AutopilotLinkTest, MountTiltsSensor) {
    settings_.directions.body_from_sensor.linear() =
        Eigen::AngleAxisd(0.5, Eigen::Vector3d::UnitY()).toRotationMatrix();
    link_ = std::make_unique<AutopilotLink>(settings_, [](const std::string&) {});
    link_->begin(sensor_, {20, 0});
    autopilot_.receive();
    autopilot_.send(Vehicle().attitude(100));
    for (int i = 0; i < 200 && count("attitude") == 0; ++i) autopilot_.receive();
    const auto motion = link_->motionAt(now_s());
    ASSERT_TRUE(motion.attitude);
    EXPECT_NEAR(motion.attitude->pitch_rad, 0.5, 1e-5);
}

}  // namespace
}  // namespace hagen::live
