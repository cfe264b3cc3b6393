// live-segment --mavlink, tested with a simulated autopilot.
#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <hagen/scan/Angle.h>
#include <hagen/sensors/VelodyneCalibration.h>
#include <stdlib.h>
#include <unistd.h>
#include "live/autopilot/Messages.h"
#include "live/mavlink/Parser.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <iostream>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <random>
#include <sstream>
#include <thread>

#include "live/Vehicle.h"
#include "support/CaptureWriter.h"
#include "support/LocalUdp.h"
#include "support/ProgramTest.h"
#include "support/SimpleFirings.h"

namespace hagen {
namespace {

using live::Vehicle;
using testing::HasSubstr;

constexpr std::uint16_t kNothing_cm = 2001, kUnknown_cm = 65535;

constexpr auto now_s = test::steadyNow_s;
using test::freePort;

/// Two poles on flat ground, seen from 2 m: one 20 degrees left of ahead, one on the right.
test::SimpleScene poles() { return test::sceneOf({}, {{8, 3, 0.2, 6}, {-1, -6, 0.2, 6}}); }

/// A local UDP socket that stores the bytes it receives.
class Autopilot {
 public:
    Autopilot() : receiver_([this] { receive(); }) {}
    ~Autopilot() { stop(); }
    void stop() {
        is_at_end_ = true;
        if (receiver_.joinable()) receiver_.join();
    }
    /// Replies to the first sender.
    void send(mavlink::Frame frame) {
        if (!has_sender_) return;
        frame.sequence = sequence_++;
        frame.system = frame.component = 1;
        socket_.send(mavlink::encode(frame, 48), from_);
    }
    std::string peer() const { return "udp:127.0.0.1:" + std::to_string(socket_.port()); }
    bool hasSender() const { return has_sender_; }
    /// Call stop() first.
    const std::string& bytes() const { return bytes_; }
    std::vector<mavlink::Frame> frames() const { return framesOf(bytes_); }

    static std::vector<mavlink::Frame> framesOf(const std::string& bytes) {
        std::vector<mavlink::Frame> frames;
        mavlink::Parser parser;
        const auto take = [&](const mavlink::Frame& frame) { frames.push_back(frame); };
        parser.add(reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size(), take);
        parser.end(take);
        EXPECT_EQ(parser.counts().skipped_bytes, 0u);
        EXPECT_EQ(parser.counts().lost, 0u);
        return frames;
    }

 private:
    void receive() {
        while (!is_at_end_) {
            const auto datagram = socket_.receive();
            if (!datagram) continue;
            bytes_ += datagram->bytes;
            if (has_sender_) continue;
            from_ = datagram->from;
            has_sender_ = true;
        }
    }

    test::LocalUdp socket_{std::chrono::milliseconds(10)};
    std::uint8_t sequence_ = 0;
    sockaddr_in from_{};
    std::atomic<bool> has_sender_ = false, is_at_end_ = false;
    std::string bytes_;
    std::thread receiver_;
};

template <class Message>
std::vector<Message> all(const std::vector<mavlink::Frame>& frames) {
    std::vector<Message> messages;
    for (const mavlink::Frame& frame : frames) {
        if (const auto message = mavlink::messageOf<Message>(frame)) messages.push_back(*message);
    }
    return messages;
}

/// Whether a replay took much longer than `replay_s`: directions may then correctly be unknown.
bool isTooSlow(const std::vector<mavlink::Frame>& frames, double replay_s) {
    const auto distances = all<mavlink::ObstacleDistance>(frames);
    if (distances.empty()) return true;
    const double took_s =
        1e-6 * static_cast<double>(distances.back().time_usec - distances.front().time_usec);
    return took_s > 1.3 * replay_s + 0.3;
}

class LiveSegmentMavlink : public test::ProgramTest {
 protected:
    test::Outcome run(const std::vector<std::string>& arguments) const override {
        return test::run(HAGEN_LIVE_SEGMENT, with({"--model", "VLP-16"}, arguments));
    }
    /// Turns of a static sensor, with a pause halfway through.
    std::string capture(int turns, double pause_s = 0) const {
        const auto& model = sensors::velodyneModel("VLP-16");
        observations::Firings firings = test::fireAt(poles(), model, {0, 0, 2});
        test::CaptureWriter writer;
        for (int k = 0; k < turns; ++k) {
            const double time_s = 0.1 * k + (k >= turns / 2 ? pause_s : 0);
            firings.first_time_us = static_cast<std::uint32_t>(1e6 * time_s);
            writer.packets(*encodeScan(model, firings), 1700000000 + time_s, 1.327e-3);
        }
        return writer.write(path("flight.pcap"));
    }
    nlohmann::json stats() const {
        return nlohmann::json::parse(test::readFile(path("stats.json")))["mavlink"];
    }
};

TEST_F(LiveSegmentMavlink, SendsObstacles) {
    Autopilot autopilot;
    const auto outcome = run({"--replay", capture(12), "--mavlink", autopilot.peer(), "--stats",
                              path("stats.json"), "--obstacles", "2"});
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    autopilot.stop();
    EXPECT_THAT(outcome.out, HasSubstr("MAVLink: "));
    const auto frames = autopilot.frames();
    if (isTooSlow(frames, 1.2)) GTEST_SKIP() << "this machine is too slow at the moment";
    const auto distances = all<mavlink::ObstacleDistance>(frames);
    ASSERT_GT(distances.size(), 10u);
    const auto is_right = [](const mavlink::ObstacleDistance& message) {
        for (int k = 0; k < 72; ++k) {
            const double deg = 5.0 * k;
            const int distance_cm = message.distances[k];
            const bool is_left_pole = std::abs(deg - (360 - 20.6)) < 6;
            const bool is_right_pole = std::abs(deg - 99.5) < 6;
            const bool is_expected = deg == 340      ? std::abs(distance_cm - 834) < 8
                                     : deg == 100    ? std::abs(distance_cm - 588) < 8
                                     : is_left_pole  ? distance_cm > 800
                                     : is_right_pole ? distance_cm > 550
                                                     : distance_cm == kNothing_cm;
            if (!is_expected) return false;
        }
        return true;
    };
    // Only the first messages and the last one may differ.
    EXPECT_GT(std::count_if(distances.begin(), distances.end(), is_right),
              static_cast<std::ptrdiff_t>(distances.size() / 2));
    for (const std::uint16_t distance_cm : distances.back().distances) {
        EXPECT_EQ(distance_cm, kUnknown_cm);
    }
    const auto obstacles = all<mavlink::ObstacleDistance3d>(frames);
    ASSERT_GT(obstacles.size(), 4u);
    // Two obstacles per turn, the nearer first; on a busy machine, the very first may be missing.
    const auto middle = obstacles.begin() + static_cast<std::ptrdiff_t>(obstacles.size() / 2);
    const auto& nearest = *std::min_element(middle, middle + 2, [](const auto& a, const auto& b) {
        return std::hypot(a.x, a.y) < std::hypot(b.x, b.y);
    });
    EXPECT_NEAR(std::hypot(nearest.x, nearest.y), 5.88, 0.1);
    EXPECT_GT(nearest.y, 5);  // on the right
    for (const auto& below : all<mavlink::DistanceSensor>(frames)) {
        EXPECT_NEAR(below.current_distance, 200, 8);
    }
    EXPECT_GT(all<mavlink::DistanceSensor>(frames).size(), 3u);
    const auto json = stats();
    EXPECT_EQ(json["obstacle_distance"], distances.size());
    EXPECT_EQ(json["obstacle_distance_3d"], obstacles.size());
    EXPECT_EQ(json["not_sent"], 0);
}

/// tests/live/read_mavlink.mjs uses an independent parser with its own message definitions.
TEST_F(LiveSegmentMavlink, IndependentParserAgrees) {
    const std::filesystem::path modules = test::dataFolder("HAGEN_NODE_MODULES");
    if (modules.empty()) GTEST_SKIP() << "HAGEN_NODE_MODULES is not a folder with node-mavlink";
    Autopilot autopilot;
    ASSERT_EQ(run({"-q", "--replay", capture(12), "--mavlink", autopilot.peer()}).exit_code, 0);
    autopilot.stop();
    const auto file = folder_.write("bytes", autopilot.bytes());
    const auto read =
        test::run("/usr/bin/env",
                  {"-C", modules.string(), "node",
                   std::string(HAGEN_SOURCE_DIR) + "/tests/live/read_mavlink.mjs", file.string()});
    if (read.exit_code == 127 || read.exit_code == 77) {
        GTEST_SKIP() << "node or node-mavlink is missing: " << read.err;
    }
    ASSERT_EQ(read.exit_code, 0) << read.err;

    const auto frames = autopilot.frames();
    if (isTooSlow(frames, 1.2)) GTEST_SKIP() << "this machine is too slow at the moment";
    std::map<std::string, int> messages;
    std::optional<std::uint64_t> last_us;
    std::size_t line_number = 0;
    std::istringstream lines(read.out);
    nlohmann::json json;
    for (std::string line; std::getline(lines, line); ++line_number) {
        json = nlohmann::json::parse(line);
        if (json.contains("counts")) break;
        ++messages[json["name"]];
        const auto& frame = frames.at(line_number);
        EXPECT_EQ(json["magic"], 0xfd);
        EXPECT_EQ(json["seq"], line_number % 256);
        EXPECT_EQ(json["sysid"], 1);
        EXPECT_EQ(json["compid"], 196);
        const auto& value = json["value"];
        if (const auto m = mavlink::messageOf<mavlink::ObstacleDistance>(frame)) {
            EXPECT_EQ(json["name"], "OBSTACLE_DISTANCE");
            EXPECT_EQ(value["distances"], m->distances);
            EXPECT_EQ(value["timeUsec"], m->time_usec);
            EXPECT_EQ(value["minDistance"], 1);
            EXPECT_EQ(value["maxDistance"], 2000);
            EXPECT_EQ(value["increment"], 5);
            EXPECT_EQ(value["incrementF"], 5.0);
            EXPECT_EQ(value["angleOffset"], 0.0);
            EXPECT_EQ(value["frame"], 12);
            EXPECT_EQ(value["sensorType"], 0);
            if (last_us) {
                EXPECT_GT(m->time_usec, *last_us);
            }
            last_us = m->time_usec;
        } else if (const auto d3 = mavlink::messageOf<mavlink::ObstacleDistance3d>(frame)) {
            EXPECT_EQ(json["name"], "OBSTACLE_DISTANCE_3D");
            EXPECT_NEAR(value["x"], d3->x, 1e-6);
            EXPECT_NEAR(value["y"], d3->y, 1e-6);
            EXPECT_NEAR(value["z"], d3->z, 1e-6);
            EXPECT_EQ(value["obstacleId"], d3->obstacle_id);
            EXPECT_EQ(value["frame"], 12);
            EXPECT_EQ(value["maxDistance"], 20.0);
            EXPECT_EQ(value["timeBootMs"], d3->time_boot_ms);
        } else if (mavlink::messageOf<mavlink::DistanceSensor>(frame)) {
            EXPECT_EQ(json["name"], "DISTANCE_SENSOR");
            EXPECT_NEAR(value["currentDistance"], 200, 8);
            EXPECT_EQ(value["orientation"], 25);
            EXPECT_EQ(value["covariance"], 255);
            EXPECT_EQ(value["type"], 0);
        } else {
            EXPECT_EQ(json["name"], "HEARTBEAT");
            EXPECT_EQ(value["type"], 18);
            EXPECT_EQ(value["autopilot"], 8);
            EXPECT_EQ(value["mavlinkVersion"], 3);
        }
    }
    ASSERT_TRUE(json.contains("counts")) << read.out;
    EXPECT_EQ(line_number, frames.size());
    EXPECT_EQ(json["counts"]["bad"], 0);
    EXPECT_EQ(json["counts"]["bytes"], autopilot.bytes().size());
    // Per heartbeat: 20 OBSTACLE_DISTANCE and 10 times up to 5 OBSTACLE_DISTANCE_3D.
    EXPECT_GE(messages["OBSTACLE_DISTANCE"], 20 * (messages["HEARTBEAT"] - 1));
    EXPECT_GT(messages["HEARTBEAT"], 0);
    EXPECT_GT(messages["OBSTACLE_DISTANCE_3D"], 4);
    EXPECT_GT(messages["DISTANCE_SENSOR"], 3);
}

/// One letter per change of state: k if all directions are known, u if all are unknown.
std::string statesOf(const std::vector<mavlink::Frame>& frames) {
    std::string states;
    for (const auto& message : all<mavlink::ObstacleDistance>(frames)) {
        const auto& d = message.distances;
        const auto unknown = std::count(d.begin(), d.end(), kUnknown_cm);
        const char state = unknown == 72 ? 'u' : unknown == 0 ? 'k' : ' ';
        if (state != ' ' && (states.empty() || states.back() != state)) states += state;
    }
    return states;
}

TEST_F(LiveSegmentMavlink, ReportsSilenceAsUnknown) {
    const std::string silent = capture(10, 1.2);
    // Retry: starved of CPU time, the program correctly sends more unknown directions.
    constexpr int kAttempts = 5;
    for (int attempt = 1; attempt <= kAttempts; ++attempt) {
        Autopilot autopilot;
        const auto outcome = run({"--replay", silent, "--mavlink", autopilot.peer(), "--stats",
                                  path("stats.json"), "--overwrite"});
        ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
        autopilot.stop();
        // Known, then unknown, then known again.
        const std::string states = statesOf(autopilot.frames());
        ASSERT_FALSE(states.empty());
        EXPECT_EQ(states.front(), 'u');
        EXPECT_EQ(states.back(), 'u');
        if (states.find("kuk") == std::string::npos && attempt < kAttempts) continue;
        if (isTooSlow(autopilot.frames(), 2.2)) {
            GTEST_SKIP() << "this machine is too slow at the moment";
        }
        EXPECT_THAT(states, HasSubstr("kuk"));
        EXPECT_THAT(outcome.err, HasSubstr("sending all directions as unknown"));
        EXPECT_THAT(outcome.err, HasSubstr("sending directions again"));
        EXPECT_GE(stats()["stalls"], 1);
        EXPECT_GT(stats()["all_unknown"], 5);
        return;
    }
}

/// Sends sensor packets and attitudes of a yawing and rolling vehicle in real time.
class FlyingSensor {
 public:
    FlyingSensor(std::uint16_t port, Autopilot& autopilot)
        : autopilot_(autopilot), start_s_(now_s()), to_(test::localAddress(port)) {
        firings_.range_m.resize(16, 24);
        firings_.intensity.setConstant(16, 24, 0.5f);
    }

    Vehicle vehicleAt(double time_s) const {
        const double t = time_s - start_s_, roll = 0.14, rate = 4, yaw_rate = 1;
        Vehicle vehicle;
        vehicle.yaw_rad = yaw_rate * t;
        vehicle.roll_rad = roll * std::sin(rate * t);
        vehicle.rates_rad_s = {roll * rate * std::cos(rate * t),
                               yaw_rate * std::sin(vehicle.roll_rad),
                               yaw_rate * std::cos(vehicle.roll_rad)};
        return vehicle;
    }
    /// Sends the next packet when it is due.
    void send() {
        const auto& model = sensors::velodyneModel("VLP-16");
        const double due_s = start_s_ + 24e-6 * model.firing_period_us * packet_;
        std::this_thread::sleep_for(std::chrono::duration<double>(due_s - now_s()));
        if (packet_ % 15 == 0) {
            const double time_s = now_s();
            autopilot_.send(vehicleAt(time_s).quaternion(time_s - start_s_ + 60));
        }
        const double step_deg = 360e-5 * model.firing_period_us;
        firings_.azimuth_step_deg = step_deg;
        firings_.first_azimuth_deg = std::fmod(24 * step_deg * packet_, 360.0);
        firings_.first_time_us =
            static_cast<std::uint32_t>(24.0 * model.firing_period_us * packet_);
        measure(model, vehicleAt(now_s()));
        socket_.send(test::packetsOf(model, firings_)[0], to_);
        ++packet_;
    }

 private:
    void measure(const sensors::VelodyneModel& model, const Vehicle& vehicle) {
        static const auto rows = sensors::rowsOfLasers(sensors::defaultCalibration(model));
        static const test::SimpleScene scene = poles();
        static const SensorModel sensor = sensorModel("VLP-16");
        // Scene axes x, y, z point north, west and up.
        const Eigen::Vector3d flip(1, -1, -1);
        const Eigen::Matrix3d scene_from_sensor =
            flip.asDiagonal() * vehicle.nedFromFrd() * flip.asDiagonal();
        for (int firing = 0; firing < 24; ++firing) {
            for (int laser = 0; laser < 16; ++laser) {
                const double azimuth_rad =
                    -radians(firingAzimuthDeg(model, firings_, laser, firing));
                const double elevation_rad =
                    static_cast<double>(sensor.elevations_rad[rows[laser]]);
                const test::Hit hit =
                    castRay(scene, {0, 0, 2},
                            scene_from_sensor * test::directionOf(azimuth_rad, elevation_rad));
                firings_.range_m(laser, firing) =
                    hit.range_m < 100 ? static_cast<float>(hit.range_m) : 0;
            }
        }
    }

    Autopilot& autopilot_;
    test::LocalUdp socket_;
    int packet_ = 0;
    double start_s_;
    sockaddr_in to_{};
    observations::Firings firings_;
};

TEST_F(LiveSegmentMavlink, PolesStayInPlaceInFlight) {
    Autopilot autopilot;
    const std::uint16_t port = freePort();
    std::atomic<bool> is_done = false;
    FlyingSensor sensor(port, autopilot);
    std::thread sender([&] {
        while (!is_done) sensor.send();
    });
    const auto outcome =
        run({"--listen", "127.0.0.1:" + std::to_string(port), "--duration", "4", "--mavlink",
             autopilot.peer(), "--stats", path("stats.json"), "--record", path("flight.pcap")});
    is_done = true;
    sender.join();
    autopilot.stop();
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_GT(stats()["attitude"], 50);
    EXPECT_THAT(outcome.err, HasSubstr("receiving the attitude of vehicle 1"));

    std::istringstream poses(test::readFile(path("flight.tum")));
    poses.ignore(100, '\n');  // column names
    double time_s, x, y, z, max_tilt_rad = 0;
    Eigen::Quaterniond turn;
    while (poses >> time_s >> x >> y >> z >> turn.x() >> turn.y() >> turn.z() >> turn.w()) {
        max_tilt_rad = std::max(max_tilt_rad, std::acos((turn * Eigen::Vector3d::UnitZ()).z()));
    }
    EXPECT_NEAR(max_tilt_rad, 0.14, 0.03);  // maximum roll of FlyingSensor
    const auto converted = test::run(
        HAGEN_RAWLOG_SEGMENT,
        {"-i", path("flight.pcap"), "--poses", path("flight.tum"), "-o", path("flight.rawlog")});
    EXPECT_EQ(converted.exit_code, 0) << converted.err;

    const auto messages = all<mavlink::ObstacleDistance>(autopilot.frames());
    ASSERT_GT(messages.size(), 40u);
    // All processes share a clock. If the program is starved of CPU time, its directions are
    // unknown and a few messages may be wrong.
    int compared = 0, wrong = 0;
    for (std::size_t i = messages.size() / 3; i + 1 < messages.size(); ++i) {
        const auto& distances = messages[i].distances;
        if (std::count(distances.begin(), distances.end(), kUnknown_cm) > 0) continue;
        const Vehicle vehicle = sensor.vehicleAt(1e-6 * static_cast<double>(messages[i].time_usec));
        bool is_right = true;
        std::vector<bool> may_be(72, false);
        for (const auto& pole : poles().poles) {
            const Eigen::Vector3d foot_ned(pole.x_m, -pole.y_m, 0);
            const double bearing_deg = vehicle.bearing_deg(foot_ned);
            const double distance_cm = 100 * (std::hypot(pole.x_m, pole.y_m) - pole.radius_m);
            double nearest_cm = kNothing_cm;
            for (double deg = bearing_deg - 4; deg <= bearing_deg + 4; deg += 0.5) {
                const auto k = static_cast<std::size_t>((deg + 362.5) / 5) % 72;
                may_be[k] = true;
                nearest_cm = std::min<double>(nearest_cm, distances[k]);
            }
            is_right = is_right && std::abs(nearest_cm - distance_cm) < 20;
        }
        for (std::size_t k = 0; k < 72; ++k) {
            is_right = is_right && (may_be[k] || distances[k] == kNothing_cm);
        }
        ++compared;
        wrong += is_right ? 0 : 1;
    }
    RecordProperty("compared", compared);
    RecordProperty("wrong", wrong);
    if (compared < 20) GTEST_SKIP() << "this machine is too slow at the moment: " << compared;
    EXPECT_LE(wrong, compared / 5) << "of " << compared;
}

/// Sends turns over a network that drops, duplicates, delays and injects packets.
class FaultyNetwork {
 public:
    explicit FaultyNetwork(std::uint16_t port)
        : start_s_(now_s()), to_(test::localAddress(port)), random_(1) {
        const auto& model = sensors::velodyneModel("VLP-16");
        observations::Firings firings = test::fireAt(poles(), model, {0, 0, 2});
        packets_ = test::packetsOf(model, firings);
        packet_rad_ = radians(24 * firings.azimuth_step_deg);
    }

    void send() {
        constexpr double kPeriod_s = 0.1 / 76;  // 76 packets per turn; the last one overlaps
        const double time_s = kPeriod_s * static_cast<double>(sent_);
        std::this_thread::sleep_for(std::chrono::duration<double>(start_s_ + time_s - now_s()));
        const std::size_t k = sent_++ % packets_.size();
        std::string bytes = packets_[k];
        const auto us = static_cast<std::uint32_t>(1e6 * time_s);
        std::memcpy(&bytes[1200], &us, sizeof us);
        // Every other second, packets of a 60 degree sector are dropped.
        const double second = std::fmod(time_s, 2.0);
        const double deg = degrees(static_cast<double>(k) * packet_rad_);
        const double blind_deg = std::fmod(time_s * 37, 360.0);
        if (second > 1 && std::fmod(deg - blind_deg + 720, 360.0) < 60) return count();
        switch (random_() % 20) {
            case 0:
            case 1:
                return count();  // dropped
            case 2:
                deliver(bytes, k);
                deliver(bytes, k);
                return count();
            case 3:
                if (late_.empty()) {
                    late_ = bytes;
                    late_k_ = k;
                    return count();
                }
                break;
            case 4:
                deliver(std::string(random_() % 1300, static_cast<char>(random_())), {});
                count();
                break;
            case 5: {
                std::string other = bytes;
                other.back() = '\x21';  // product ID of an HDL-32E
                deliver(other, {});
                count();
                break;
            }
            default:
                break;
        }
        deliver(bytes, k);
        if (!late_.empty() && random_() % 3 == 0) {
            deliver(late_, late_k_);
            late_.clear();
        }
    }

    /// Whether a packet delivered between two times measured this azimuth.
    bool wasMeasured(double clockwise_deg, double from_s, double to_s) const {
        for (auto delivery = deliveries_.rbegin(); delivery != deliveries_.rend(); ++delivery) {
            if (delivery->time_s < from_s) return false;
            if (delivery->time_s - 0.01 > to_s) continue;
            const double into_deg =
                clockwise_deg - degrees(static_cast<double>(delivery->k) * packet_rad_) + 0.6;
            if (std::fmod(into_deg + 720, 360.0) < degrees(packet_rad_) + 1.2) return true;
        }
        return false;
    }
    std::size_t faults() const { return faults_; }

 private:
    struct Delivery {
        double time_s;  ///< right after sending
        std::size_t k;
    };
    void count() { ++faults_; }
    void deliver(const std::string& bytes, std::optional<std::size_t> k) {
        socket_.send(bytes, to_);
        if (k) deliveries_.push_back({now_s(), *k});
    }

    test::LocalUdp socket_;
    double start_s_, packet_rad_;
    sockaddr_in to_{};
    std::mt19937 random_;
    std::vector<std::string> packets_;
    std::vector<Delivery> deliveries_;
    std::string late_;
    std::size_t late_k_ = 0, sent_ = 0, faults_ = 0;
};

TEST_F(LiveSegmentMavlink, StaleDirectionsAreNotFree) {
    const char* const longer = std::getenv("HAGEN_NETWORK_FAULT_SECONDS");
    const std::string duration = longer != nullptr ? longer : "4";
    Autopilot autopilot;
    const std::uint16_t port = freePort();
    std::atomic<bool> is_done = false;
    FaultyNetwork network(port);
    std::thread sender([&] {
        while (!is_done) network.send();
    });
    const auto outcome = run({"-q", "--listen", "127.0.0.1:" + std::to_string(port), "--duration",
                              duration, "--mavlink", autopilot.peer()});
    is_done = true;
    sender.join();
    autopilot.stop();
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    std::size_t free = 0, unknown = 0, obstacles = 0, stale = 0;
    for (const auto& message : all<mavlink::ObstacleDistance>(autopilot.frames())) {
        const double time_s = 1e-6 * static_cast<double>(message.time_usec);
        for (std::size_t k = 0; k < 72; ++k) {
            unknown += message.distances[k] == kUnknown_cm ? 1 : 0;
            obstacles += message.distances[k] < kNothing_cm ? 1 : 0;
            if (message.distances[k] != kNothing_cm) continue;
            ++free;
            for (int part = 0; part < 5; ++part) {
                const double deg = 5 * static_cast<double>(k) - 2 + part;
                if (network.wasMeasured(deg, time_s - 0.3, time_s)) continue;
                ++stale;
                ADD_FAILURE() << "direction " << k << " is free at " << time_s << ", but " << deg
                              << " degrees were not measured";
                break;
            }
        }
    }
    EXPECT_EQ(stale, 0u);
    EXPECT_GT(network.faults(), 300u);
    EXPECT_GT(unknown, 100u);
    std::cout << network.faults() << " faults: " << free << " directions free, " << unknown
              << " unknown, " << obstacles << " obstacles, " << stale << " stale and free\n";
    if (free < 500 || obstacles < 50) {
        GTEST_SKIP() << "this machine is too slow at the moment: too few directions were known";
    }
}

TEST_F(LiveSegmentMavlink, SerialLineGetsSameMessages) {
    const int line = posix_openpt(O_RDWR | O_NOCTTY | O_NONBLOCK);
    ASSERT_GE(line, 0);
    grantpt(line);
    unlockpt(line);
    const std::string name = ptsname(line);
    std::atomic<bool> is_done = false;
    std::string bytes;
    std::thread reader([&] {
        std::array<char, 4096> buffer{};
        while (!is_done) {
            const ssize_t got = read(line, buffer.data(), buffer.size());
            if (got > 0) bytes.append(buffer.data(), static_cast<std::size_t>(got));
            if (got <= 0) std::this_thread::sleep_for(std::chrono::milliseconds(2));
        }
    });
    const auto outcome =
        run({"-q", "--replay", capture(8), "--mavlink", "serial:" + name + ":921600",
             "--mavlink-system", "7", "--no-ground", "--obstacles", "0"});
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
    is_done = true;
    reader.join();
    close(line);
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    const auto frames = Autopilot::framesOf(bytes);
    EXPECT_GT(all<mavlink::ObstacleDistance>(frames).size(), 8u);
    for (const auto& frame : frames) {
        EXPECT_EQ(frame.system, 7);
        EXPECT_TRUE(frame.id == mavlink::ObstacleDistance::kId ||
                    frame.id == mavlink::Heartbeat::kId);
    }
}

TEST_F(LiveSegmentMavlink, ContinuesWithoutAutopilot) {
    std::string peer;
    {
        Autopilot gone;
        peer = gone.peer();
    }
    const auto outcome =
        run({"--replay", capture(6), "--mavlink", peer, "--stats", path("stats.json")});
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_THAT(outcome.err, HasSubstr("connection refused"));
    EXPECT_EQ(stats()["peer_troubles"], 1);
    EXPECT_EQ(stats()["received"], 0);
}

TEST_F(LiveSegmentMavlink, RejectsInvalidPeers) {
    const std::string file = capture(2);
    const auto with_peer = [&](const std::string& peer) {
        return std::vector<std::string>{"-q", "--replay", file, "--mavlink", peer};
    };
    expectFailure(with_peer("192.168.1.10:14550"), 2, "neither udp:HOST:PORT nor serial:DEVICE");
    expectFailure(with_peer("udp:192.168.1.10:0"), 2, "1 to 65535");
    expectFailure(with_peer("serial:/dev/ttyS0:57600"), 2, "at least 115200 baud");
    expectFailure(with(with_peer("serial:/dev/ttyS0:115200"), {"--obstacles", "20"}), 2,
                  "20 obstacles require 130900 baud");
    expectFailure(with_peer("serial:" + path("none") + ":115200"), 1, "No such file");
    expectFailure({"--replay", file, "--mavlink-system", "2"}, 2, "--mavlink");
    expectFailure(with(with_peer("udp:127.0.0.1:9"), {"--mavlink-system", "0"}), 2,
                  "--mavlink-system");
    expectFailure(with(with_peer("udp:127.0.0.1:9"), {"--obstacle-height", "-1"}), 2,
                  "--obstacle-height");
}

}  // namespace
}  // namespace hagen
