// rawlog-segment on network captures, as a user would run it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <hagen/recordings/RawlogReader.h>
#include <hagen/sensors/OusterSensor.h>
#include <mrpt/obs/CObservationVelodyneScan.h>

#include <nlohmann/json.hpp>

#include "support/CaptureWriter.h"
#include "support/OusterPackets.h"
#include "support/ProgramTest.h"

namespace hagen {
namespace {

using testing::HasSubstr;

namespace fs = std::filesystem;

class RawlogSegmentCapture : public test::ProgramTest {
 protected:
    test::Outcome run(const std::vector<std::string>& arguments) const override {
        return test::run(HAGEN_RAWLOG_SEGMENT, arguments);
    }
    /// The scans of the recording that comes with the project, as the packets that made them.
    std::string captureOfRecording() const {
        recordings::RawlogReader reader(fs::path(HAGEN_SOURCE_DIR) /
                                        "rawlogs/poles_and_wall.rawlog");
        test::CaptureWriter writer;
        while (const auto entry = reader.next()) {
            const auto scan = std::dynamic_pointer_cast<mrpt::obs::CObservationVelodyneScan>(entry);
            if (!scan) continue;
            writer.packets(*scan, mrpt::Clock::toDouble(scan->timestamp), 1.3e-3);
        }
        return writer.write(path("flight.pcap"));
    }
    /// All bytes of a folder's labels.
    std::string labelsOf(const std::string& folder) const {
        std::set<fs::path> names;
        for (const auto& file : fs::directory_iterator(path(folder) + "/labels")) {
            names.insert(file.path());
        }
        std::string all;
        for (const fs::path& name : names) {
            all += name.filename().string() + ":" + test::readFile(name);
        }
        return all;
    }
};

TEST_F(RawlogSegmentCapture, ACaptureAndARawlogOfTheSameScansGiveTheSameLabels) {
    const auto outcome =
        run({"-i", captureOfRecording(), "-o", path("of_capture.rawlog"), "--kitti", path("a")});
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_THAT(outcome.out, HasSubstr("LiDAR scans in "));
    EXPECT_THAT(outcome.out, HasSubstr("sensor velodyne: VLP-16, 16 beams"));
    EXPECT_THAT(outcome.err, HasSubstr("velodyne (VLP-16 at 10.0.0.100, port 2368): "));
    // The output holds the scans, packets and all.
    ASSERT_EQ(run({"-q", "-i", path("of_capture.rawlog"), "--kitti", path("b")}).exit_code, 0);
    EXPECT_EQ(labelsOf("a"), labelsOf("b"));
    EXPECT_GT(labelsOf("a").size(), 100000u);
}

TEST_F(RawlogSegmentCapture, TheSameBytesForAnyNumberOfThreads) {
    const std::string capture = captureOfRecording();
    for (const std::string jobs : {"1", "3"}) {
        ASSERT_EQ(
            run({"-q", "-i", capture, "-o", path(jobs + ".rawlog"), "--jobs", jobs}).exit_code, 0);
    }
    EXPECT_EQ(test::readFile(path("1.rawlog")), test::readFile(path("3.rawlog")));
}

TEST_F(RawlogSegmentCapture, ACutCaptureKeepsWhatIsBeforeTheCut) {
    const std::string capture = captureOfRecording();
    fs::resize_file(capture, fs::file_size(capture) / 2);
    const auto outcome = run({"-i", capture, "-o", path("out.rawlog")});
    EXPECT_EQ(outcome.exit_code, 1);
    EXPECT_THAT(outcome.err, HasSubstr("flight.pcap: frame "));
    EXPECT_THAT(outcome.err, HasSubstr("entries before it are in " + path("out.partial.rawlog")));
    EXPECT_FALSE(fs::exists(path("out.rawlog")));
    recordings::RawlogReader reader(path("out.partial.rawlog"));
    while (reader.next()) {
    }
    EXPECT_GE(reader.entries(), 12u);  // four scans, each with two clouds
}

TEST_F(RawlogSegmentCapture, NoCutCrashesIt) {
    const std::string whole = test::readFile(captureOfRecording()).substr(0, 200000);
    for (std::size_t cut = 0; cut < 12; ++cut) {
        test::writeBytes(path("cut.pcap"), whole.substr(0, cut * whole.size() / 12));
        const auto outcome =
            run({"-i", path("cut.pcap"), "--stats", path("s.json"), "--overwrite"});
        EXPECT_TRUE(outcome.exit_code == 0 || outcome.exit_code == 1) << outcome.err;
        EXPECT_EQ(outcome.exit_code == 0,
                  outcome.err.find("rawlog-segment: ") == std::string::npos);
    }
}

TEST_F(RawlogSegmentCapture, AnOusterNeedsItsMetadata) {
    const std::string json = folder_.write("ouster.json", test::ousterJson());
    const auto sensor = sensors::readOusterSensor(json);
    test::CaptureWriter writer;
    for (const auto& packet : test::packetsOf(sensor, test::randomFrame(sensor, 1))) {
        test::SentDatagram datagram;
        datagram.content = packet;
        writer.datagram(datagram);
    }
    const std::string capture = writer.write(path("ouster.pcap"));
    const std::string config =
        folder_.write("four_beams.yaml", "window_size: 2\nprincipal_components: 1\n");
    const auto outcome = run({"-i", capture, "--sensor-json", json, "-o", path("out.rawlog"),
                              "--kitti", path("scans"), "-c", config});
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_THAT(outcome.out, HasSubstr("sensor ouster: OS-0-32-U1, 4 beams"));
    EXPECT_THAT(outcome.err, HasSubstr("ouster (OS-0-32-U1, RNG19_RFL8_SIG16_NIR16): 4 packets"));
    recordings::RawlogReader reader(path("out.rawlog"));
    while (reader.next()) {
    }
    EXPECT_EQ(reader.entries(), 3u);

    const std::string out = path("other.rawlog");
    expectFailure({"-i", capture, "-o", out}, 1, "--sensor-json FILE");
    expectFailure({"-i", capture, "--sensor-json", path("none.json"), "-o", out}, 2,
                  "--sensor-json");
    const std::string cut = folder_.write("cut.json", test::ousterJson().substr(0, 200));
    expectFailure({"-i", capture, "--sensor-json", cut, "-o", out}, 1,
                  "cut.json: not metadata of an Ouster");
    const std::string other = folder_.write("other.json", test::ousterJson("LEGACY"));
    expectFailure({"-i", capture, "--sensor-json", other, "-o", out}, 1,
                  "Is it another sensor's metadata?");
    expectFailure({"-i", path("out.rawlog"), "--sensor-json", json, "-o", out}, 1, "is no capture");
}

TEST_F(RawlogSegmentCapture, ACaptureOfSomethingElseIsNamed) {
    test::SentDatagram ouster;
    ouster.content = std::string(8448, '\0');
    ouster.to_port = 7502;
    const std::string capture = test::CaptureWriter().datagram(ouster).write(path("ouster.pcap"));
    expectFailure({"-i", capture, "-o", path("out.rawlog")}, 1,
                  "ouster.pcap: has no data packets of a known Velodyne");
    const std::string wifi = test::CaptureWriter(105).write(path("wifi.pcap"));
    expectFailure({"-i", wifi, "-o", path("out.rawlog")}, 1, "on a link of type IEEE802_11");
}

}  // namespace
}  // namespace hagen
