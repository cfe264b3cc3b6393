// live-segment, run as a user would.
#include <fcntl.h>
#include <gmock/gmock.h>
#include <hagen/base/OutputPath.h>
#include <hagen/recordings/RawlogReader.h>
#include <hagen/sensors/CaptureFile.h>
#include <hagen/sensors/VelodynePacket.h>
#include <mrpt/obs/CObservationVelodyneScan.h>
#include <sys/wait.h>
#include <unistd.h>

#include <atomic>
#include <csignal>
#include <cstring>
#include <nlohmann/json.hpp>
#include <thread>

#include "support/BagWriter.h"
#include "support/CaptureWriter.h"
#include "support/LivoxPackets.h"
#include "support/LocalUdp.h"
#include "support/ProgramTest.h"
#include "support/ReadRawlog.h"

namespace hagen {
namespace {

using test::freePort;
using testing::HasSubstr;

namespace fs = std::filesystem;

class LiveSegment : public test::ProgramTest {
 protected:
    test::Outcome run(const std::vector<std::string>& arguments) const override {
        return test::run(HAGEN_LIVE_SEGMENT, arguments);
    }
    static std::vector<mrpt::obs::CObservationVelodyneScan::Ptr> scans() {
        recordings::RawlogReader reader(fs::path(HAGEN_SOURCE_DIR) /
                                        "rawlogs/poles_and_wall.rawlog");
        std::vector<mrpt::obs::CObservationVelodyneScan::Ptr> all;
        while (const auto entry = reader.next()) {
            const auto scan = std::dynamic_pointer_cast<mrpt::obs::CObservationVelodyneScan>(entry);
            if (!scan) continue;
            // The recording repeats one turn with unchanged times, unlike a real sensor.
            for (auto& packet : scan->scan_packets) {
                auto* const at =
                    reinterpret_cast<std::uint8_t*>(&packet) + sensors::kVelodyneTimeAt;
                std::uint32_t time_us = 0;
                std::memcpy(&time_us, at, sizeof time_us);
                time_us += static_cast<std::uint32_t>(100000 * all.size());
                std::memcpy(at, &time_us, sizeof time_us);
            }
            all.push_back(scan);
        }
        return all;
    }
    static std::vector<std::string> packets() {
        std::vector<std::string> all;
        for (const auto& scan : scans()) {
            for (const auto& packet : scan->scan_packets) all.push_back(test::bytesOf(packet));
        }
        return all;
    }
    std::string capture() const {
        test::CaptureWriter writer;
        double time_s = 1700000000;
        for (const auto& scan : scans()) {
            writer.packets(*scan, time_s, 1.33e-3);
            time_s += 0.1;
        }
        return writer.write(path("flight.pcap"));
    }
    nlohmann::json stats() const {
        return nlohmann::json::parse(test::readFile(path("stats.json")));
    }

    /// Expects live.pcap to convert to the same bytes as another capture.
    void expectSameLabels(const std::string& file, const std::vector<std::string>& flags) const {
        for (const auto& [in, out] :
             {std::pair{file, "whole.rawlog"}, {path("live.pcap"), "recorded.rawlog"}}) {
            const auto outcome =
                test::run(HAGEN_RAWLOG_SEGMENT,
                          with(flags, {"-q", "--overwrite", "-i", in, "-o", path(out)}));
            ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
        }
        EXPECT_TRUE(test::readFile(path("whole.rawlog")) ==
                    test::readFile(path("recorded.rawlog")));
    }

    const std::vector<std::string> sensor_{"--model", "VLP-16"};
};

TEST_F(LiveSegment, RecordingConvertsToSameLabels) {
    const std::string file = capture();
    const auto outcome = run(with(sensor_, {"--replay", file, "--speed", "20", "--record",
                                            path("live.pcap"), "--stats", path("stats.json")}));
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_THAT(outcome.out, HasSubstr("recorded: " + path("live.pcap")));
    expectSameLabels(file, {});
    const auto json = stats();
    EXPECT_EQ(json["packets"]["dropped"], 0);
    EXPECT_EQ(json["packets"]["taken"], json["packets"]["datagrams"]);
    EXPECT_EQ(json["recorded"]["packets"], json["packets"]["datagrams"]);
    EXPECT_GT(json["sectors"], 10);
    EXPECT_GT(json["roi"], 50);
    EXPECT_EQ(json["nearest_m"].size(), 72u);
    EXPECT_GT(json["latency_ms"]["p50"], 0);
    EXPECT_GE(json["latency_ms"]["max"], json["latency_ms"]["p50"]);
}

TEST_F(LiveSegment, Mid360RecordingKeepsLabels) {
    std::vector<std::string> packets;
    for (int k = 0; k < 700; ++k) {
        packets.push_back(test::livoxPacketOfWall(k, k * test::kLivoxPacket_ns));
    }
    const std::string file = test::CaptureWriter()
                                 .datagrams(packets, 1e-9 * test::kLivoxPacket_ns, 56301)
                                 .write(path("flight.pcap"));
    const auto outcome = run({"--model", "Mid-360", "--replay", file, "--record", path("live.pcap"),
                              "--stats", path("stats.json")});
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    expectSameLabels(file, {"-c", "mid360"});
    EXPECT_EQ(stats()["packets"]["taken"], 700);
    // 4 scans in 0.336 s, each with its RoI and its ROU
    EXPECT_EQ(test::readLog(path("recorded.rawlog")).first, 3u * 4);
}

TEST_F(LiveSegment, OusterRecordingKeepsLabels) {
    const auto folder = test::dataFolder("HAGEN_OUSTER_DATA");
    if (folder.empty()) GTEST_SKIP() << "HAGEN_OUSTER_DATA is not a folder of captures";
    const std::vector<std::pair<std::string, std::string>> captures{
        {"OS-0-32-U1_v2.2.0_1024x10.pcap", "OS-0-32-U1_v2.2.0_1024x10.json"},
        {"OS-1-128_v2.3.0_1024x10_lb_n3.pcap", "OS-1-128_v2.3.0_1024x10.json"}};
    for (const auto& [capture, json] : captures) {
        const std::string file = (folder / capture).string(), sensor = (folder / json).string();
        const auto outcome = run({"--replay", file, "--sensor-json", sensor, "--record",
                                  path("live.pcap"), "--stats", path("stats.json"), "--overwrite"});
        ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
        expectSameLabels(file, {"--sensor-json", sensor});
        const auto json_stats = stats();
        EXPECT_EQ(json_stats["model"], "Ouster");
        EXPECT_GT(json_stats["packets"]["taken"], 60);
        EXPECT_EQ(json_stats["packets"]["lost"], 0);
        EXPECT_GT(json_stats["sectors"], 20);
        EXPECT_GT(json_stats["returns"], 20000);
    }
}

TEST_F(LiveSegment, RefusesToOverwriteInputs) {
    const std::string file = capture(), before = test::readFile(file);
    const std::vector<std::string> flags = with(sensor_, {"-q", "--replay", file, "--speed", "50"});
    const auto refused = [&](const std::vector<std::string>& more, const std::string& words) {
        const auto outcome = run(with(with(flags, {"--overwrite"}), more));
        EXPECT_EQ(outcome.exit_code, 1);
        EXPECT_THAT(outcome.err, HasSubstr(words));
    };
    refused({"--record", file}, "is or contains the input");
    refused({"--stats", file}, "is or contains the input");
    refused({"--record", path("a"), "--stats", path("a")}, "one output is inside the other");
    EXPECT_TRUE(test::readFile(file) == before);
}

TEST_F(LiveSegment, FailedStatisticsKeepSummary) {
    const auto outcome =
        test::run("/bin/bash", {"-c", "(ulimit -f 0; exec \"" + std::string(HAGEN_LIVE_SEGMENT) +
                                          "\" --model VLP-16 --speed 50 --replay \"" + capture() +
                                          "\" --stats \"" + path("stats.json") +
                                          "\") 2>&1 | cat; exit ${PIPESTATUS[0]}"});
    EXPECT_EQ(outcome.exit_code, 1);
    EXPECT_THAT(outcome.out, HasSubstr("packets"));  // part of the summary
    EXPECT_THAT(outcome.out, HasSubstr("stats.json: cannot be written"));
    EXPECT_FALSE(fs::exists(path("stats.json")));
}

TEST_F(LiveSegment, ReceivesFromNetwork) {
    const std::uint16_t port = freePort();
    std::vector<std::string> sent = packets();
    sent.erase(sent.begin() + 40, sent.begin() + 43);
    std::atomic<bool> is_done = false;
    // Sends until the program ends, because the time when it starts listening is unknown.
    std::thread sender([&] {
        const test::LocalUdp out;
        const auto send = [&](const std::string& bytes) {
            out.send(bytes, test::localAddress(port));
        };
        for (std::size_t i = 0; !is_done; ++i) {
            send(sent[i % sent.size()]);
            if (i % 50 == 7) send("noise");
            if (i % 50 == 9) {  // another sensor model
                std::string other = sent[i % sent.size()];
                other.back() = '\x21';
                send(other);
            }
            std::this_thread::sleep_for(std::chrono::microseconds(1300));
        }
    });
    // On a busy machine, starting and receiving enough packets takes longer.
    test::Outcome outcome{};
    for (double duration_s = 1.5; duration_s < 60; duration_s *= 2) {
        outcome = run(with(sensor_, {"--listen", "127.0.0.1:" + std::to_string(port), "--duration",
                                     std::to_string(duration_s), "--stats", path("stats.json"),
                                     "--record", path("a.pcap"), "--overwrite"}));
        if (outcome.exit_code == 0 && stats()["packets"]["taken"] > 100 &&
            stats()["packets"]["lost"] > 0) {
            break;
        }
    }
    is_done = true;
    sender.join();
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    const auto json = stats();
    EXPECT_GT(json["packets"]["taken"], 50);
    EXPECT_GT(json["packets"]["lost"], 0);
    EXPECT_GT(json["packets"]["wrong_size"], 0);
    EXPECT_GT(json["packets"]["foreign"], 0);
    EXPECT_GT(json["sectors"], 5);
    EXPECT_TRUE(fs::exists(path("a.pcap")));
}

TEST_F(LiveSegment, DoesNotLoadMrpt) {
    const auto libraries = test::run("ldd", {HAGEN_LIVE_SEGMENT});
    ASSERT_EQ(libraries.exit_code, 0) << libraries.err;
    EXPECT_THAT(libraries.out, HasSubstr("libyaml-cpp"));
    for (const char* not_needed : {"mrpt", "opencv", "octomap", "libgdal", "libGL"}) {
        EXPECT_THAT(libraries.out, testing::Not(HasSubstr(not_needed)));
    }
}

TEST_F(LiveSegment, FullDiskEndsRecordingOnly) {
    for (const std::string limit_kib : {"8", "200"}) {
        const auto outcome = test::run(
            "bash", {"-c", "ulimit -f " + limit_kib + "; exec \"$0\" \"$@\"", HAGEN_LIVE_SEGMENT,
                     "--model", "VLP-16", "--replay", capture(), "--speed", "20", "--record",
                     path("a.pcap"), "--stats", path("stats.json"), "--overwrite"});
        EXPECT_EQ(outcome.exit_code, 1);
        EXPECT_THAT(outcome.err, HasSubstr("partial recording kept in " + path("a.partial.pcap")));
        EXPECT_FALSE(fs::exists(path("a.pcap")));
        const auto json = stats();
        EXPECT_GT(json["packets"]["taken"], 0);
        EXPECT_EQ(json["packets"]["taken"], json["packets"]["datagrams"]);
        EXPECT_THAT(json["recorded"]["failure"].get<std::string>(), HasSubstr(path("a.pcap")));
        EXPECT_TRUE(fs::remove(path("a.partial.pcap")));
    }
}

TEST_F(LiveSegment, ReplaysCapturesRawlogsAndBags) {
    const auto made = test::run(HAGEN_RAWLOG_SIMULATE,
                                {"--scenario", "orchard", "--scans", "3", "--altitude", "2",
                                 "--seed", "1", "--pcap", path("a.pcap"), "-o", path("a.rawlog")});
    ASSERT_EQ(made.exit_code, 0) << made.err;
    std::vector<test::SentMessage> messages;
    recordings::RawlogReader reader(path("a.rawlog"));
    while (const auto entry = reader.next()) {
        const auto scan = std::dynamic_pointer_cast<mrpt::obs::CObservationVelodyneScan>(entry);
        if (!scan) continue;
        const double time_s = mrpt::Clock::toDouble(scan->timestamp);
        messages.push_back(test::velodyneMessage("/packets", time_s, "lidar", *scan, 1.3e-3));
    }
    folder_.write("a.bag", test::ros1BagOf(messages));
    std::set<std::size_t> roi;
    for (const char* name : {"a.pcap", "a.rawlog", "a.bag"}) {
        const auto outcome = run(
            with(sensor_, {"--replay", path(name), "--stats", path("stats.json"), "--overwrite"}));
        ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
        EXPECT_EQ(stats()["packets"]["taken"], 228) << name;
        roi.insert(stats()["roi"].get<std::size_t>());
    }
    EXPECT_EQ(roi.size(), 1u);
    EXPECT_GT(*roi.begin(), 10000u);
}

TEST_F(LiveSegment, RefusesToReplayDecodedScans) {
    folder_.write("a.bag", test::ros1BagOf({test::cloudMessage("/points", 1, "a", {1, 2, 3, 4})}));
    expectFailure(with(sensor_, {"--replay", path("a.bag")}), 1,
                  "a.bag: has no packets of a LiDAR, only decoded scans");
}

TEST_F(LiveSegment, StatusLineFitsTerminal) {
    if (test::run("script", {"--version"}).exit_code == 127) GTEST_SKIP() << "script is missing";
    const auto lastLine = [&](int columns) {
        const auto outcome = test::run(
            "script", {"-qec",
                       "stty cols " + std::to_string(columns) + "; '" + HAGEN_LIVE_SEGMENT +
                           "' --model VLP-16 --replay '" + capture() + "' > /dev/null",
                       "/dev/null"});
        const std::size_t at = outcome.out.rfind("nearest");
        EXPECT_NE(at, std::string::npos) << outcome.out;
        return outcome.out.substr(at, outcome.out.find_first_of("\r\n", at) - at);
    };
    const std::string line = lastLine(200);
    EXPECT_THAT(line, testing::MatchesRegex("nearest [0-9.]+ m at [0-9]+° [|] [0-9.]+ Hz [|] "
                                            "[0-9.]+ ms [|] .*max [0-9.]+ ms"));
    EXPECT_THAT(lastLine(35), testing::MatchesRegex("nearest [0-9.]+ m at [0-9]+° [|] [0-9.]+ Hz"));
}

/// A stopped terminal, or a pipe that is not read.
TEST_F(LiveSegment, EndsDespiteBlockedTerminal) {
    const std::string command =
        "mkfifo '" + path("fifo") + "'; exec 3<>'" + path("fifo") +
        "'; head -c 65536 /dev/zero >&3; exec timeout 20 '" + HAGEN_LIVE_SEGMENT + "' --replay '" +
        capture() + "' --model HDL-32E --speed 20 --stats '" + path("stats.json") + "' 2>&3";
    const auto outcome = test::run("/bin/bash", {"-c", command});
    EXPECT_EQ(outcome.exit_code, 1);   // the sensor is not an HDL-32E
    EXPECT_TRUE(stats().is_object());  // complete
}

/// Runs live-segment in the background and sends it packets.
class LiveSegmentKilled : public LiveSegment {
 protected:
    LiveSegmentKilled() {
        const std::uint16_t port = freePort();
        std::vector<std::string> words{
            HAGEN_LIVE_SEGMENT, "--listen", "127.0.0.1:" + std::to_string(port),
            "--model",          "VLP-16",   "--record",
            path("a.pcap"),     "--stats",  path("stats.json")};
        std::vector<char*> arguments;
        for (std::string& word : words) arguments.push_back(word.data());
        arguments.push_back(nullptr);
        process_ = fork();
        if (process_ == 0) {
            dup2(open(path("out").c_str(), O_WRONLY | O_CREAT, 0666), STDOUT_FILENO);
            dup2(open(path("err").c_str(), O_WRONLY | O_CREAT, 0666), STDERR_FILENO);
            execv(arguments[0], arguments.data());
            _exit(127);
        }
        sender_ = std::thread([this, port, sent = packets()] {
            const test::LocalUdp out;
            for (std::size_t i = 0; !is_done_; ++i) {
                out.send(sent[i % sent.size()], test::localAddress(port));
                std::this_thread::sleep_for(std::chrono::microseconds(1300));
            }
        });
    }
    ~LiveSegmentKilled() override {
        is_done_ = true;
        sender_.join();
        if (process_ > 0) {
            kill(process_, SIGKILL);
            waitpid(process_, nullptr, 0);
        }
    }
    /// Sends a signal; returns the exit code, or -1 if the signal killed live-segment.
    int end(int signal) {
        int status = 0;
        kill(process_, signal);
        waitpid(process_, &status, 0);
        process_ = -1;
        return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
    }
    static bool waitUntil(const std::function<bool()>& condition) {
        for (int i = 0; i < 3000; ++i) {
            if (condition()) return true;
            std::this_thread::sleep_for(std::chrono::milliseconds(10));
        }
        return false;
    }
    /// The temporary file of the recording, if it exists.
    std::optional<fs::path> recording() const {
        for (const auto& file : files()) {
            if (file.filename().string().find(".tmp-") != std::string::npos) return file;
        }
        return std::nullopt;
    }
    /// Whether part of the recording is on disk.
    bool hasWritten() const {
        const auto file = recording();
        return file && fs::file_size(*file) > 50000;
    }

    pid_t process_ = -1;
    std::thread sender_;
    std::atomic<bool> is_done_ = false;
};

TEST_F(LiveSegmentKilled, LeavesReadableCapture) {
    ASSERT_TRUE(waitUntil([&] { return hasWritten(); })) << test::readFile(path("err"));
    EXPECT_EQ(end(SIGKILL), -1);
    EXPECT_FALSE(fs::exists(path("a.pcap")));
    ASSERT_TRUE(recording());
    sensors::CaptureFile capture(*recording());
    sensors::Datagram datagram;
    std::size_t datagrams = 0;
    while (capture.next(datagram)) {
        EXPECT_EQ(datagram.size, 1206u);
        EXPECT_EQ(sensors::ipText(datagram.to_ip), "127.0.0.1");
        ++datagrams;
    }
    EXPECT_GT(datagrams, 40u);
}

TEST_F(LiveSegmentKilled, CompletesRecordingOnSigterm) {
    ASSERT_TRUE(waitUntil([&] { return hasWritten(); })) << test::readFile(path("err"));
    EXPECT_EQ(end(SIGTERM), 0) << test::readFile(path("err"));
    EXPECT_TRUE(fs::exists(path("a.pcap")));
    EXPECT_THAT(test::readFile(path("out")), HasSubstr("recorded: " + path("a.pcap")));
}

TEST_F(LiveSegment, FailsWithoutPackets) {
    expectFailure(with(sensor_, {"-q", "--listen", "127.0.0.1:" + std::to_string(freePort()),
                                 "--duration", "0.1"}),
                  1, "no packet from a VLP-16 received");
}

TEST_F(LiveSegment, ReportsUsedViewPort) {
    const int listener = socket(AF_INET, SOCK_STREAM, 0);
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    socklen_t size = sizeof address;
    ASSERT_EQ(bind(listener, reinterpret_cast<sockaddr*>(&address), size), 0);
    ASSERT_EQ(listen(listener, 1), 0);
    getsockname(listener, reinterpret_cast<sockaddr*>(&address), &size);
    const std::string port = std::to_string(ntohs(address.sin_port));
    expectFailure(with(sensor_, {"--replay", capture(), "--view", port}), 1,
                  "127.0.0.1:" + port + "; is the port in use?");
    close(listener);
}

TEST_F(LiveSegment, FailedStartEndsViewer) {
    folder_.write("there.pcap", "");
    expectFailure(with(sensor_, {"--replay", capture(), "--view", std::to_string(freePort()),
                                 "--record", path("there.pcap")}),
                  1, "there.pcap");
}

TEST_F(LiveSegment, RejectsInvalidFlags) {
    const std::string file = capture();
    expectFailure({"--model", "VLP-16"}, 2, "one of --listen and --replay is required");
    expectFailure({"--replay", file, "--model", "VLP-16", "--view", "here"}, 1, "--view here");
    expectFailure({"--replay", file, "--listen", "1.2.3.4:5", "--model", "VLP-16"}, 2,
                  "one of --listen and --replay is required");
    expectFailure({"--replay", file}, 2, "is required; models: VLP-16");
    expectFailure({"--replay", file, "--model", "OS1-64"}, 2, "Supported: VLP-16");
    expectFailure({"--replay", file, "--model", "vlp16"}, 2, "did you mean 'VLP-16'?");
    expectFailure({"--replay", file, "--model", "HDL-64E"}, 2, "--calibration FILE");
    expectFailure({"--listen", "here", "--model", "VLP-16"}, 2, "'here' is not an IPv4 address");
    expectFailure(with(sensor_, {"--replay", file, "--from-address", "1.2.3"}), 2,
                  "--from-address");
    expectFailure(with(sensor_, {"-q", "--replay", file, "--from-address", "1.2.3.4"}), 1,
                  "no packet from a VLP-16 at 1.2.3.4 received, but");
    expectFailure({"--listen", "0.0.0.0:2368", "--speed", "2", "--model", "VLP-16"}, 2, "--speed");
    expectFailure({"--replay", file, "--sensor-json", file, "--model", "VLP-16"}, 2, "Ouster");
    expectFailure({"--replay", file, "--sensor-json", file}, 1, "flight.pcap");
    expectFailure({"--replay", path("none.pcap"), "--model", "VLP-16"}, 2, "none.pcap");
    folder_.write("a.txt", "no capture");
    expectFailure(with(sensor_, {"--replay", path("a.txt")}), 1, "a.txt");
    folder_.write("a.pcap", "mine");
    expectFailure(with(sensor_, {"-q", "--replay", file, "--record", path("a.pcap")}), 1, "a.pcap");
    EXPECT_EQ(test::readFile(path("a.pcap")), "mine");
}

}  // namespace
}  // namespace hagen
