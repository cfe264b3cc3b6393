// rawlog-segment on network captures.
#include <hagen/recordings/RawlogReader.h>
#include <mrpt/obs/CObservationVelodyneScan.h>
#include "sensors/ouster/OusterSensor.h"

#include "support/CaptureWriter.h"
#include "support/OusterPackets.h"
#include "support/ReadRawlog.h"
#include "support/SegmentTest.h"

namespace hagen {
namespace {

using testing::HasSubstr;

class RawlogSegmentCapture : public test::SegmentTest {
 protected:
    std::string captureOfRecording() const {
        recordings::RawlogReader reader(recording());
        test::CaptureWriter writer;
        while (const auto entry = reader.next()) {
            const auto scan = std::dynamic_pointer_cast<mrpt::obs::CObservationVelodyneScan>(entry);
            if (!scan) continue;
            writer.packets(*scan, mrpt::Clock::toDouble(scan->timestamp), 1.3e-3);
        }
        return writer.write(path("flight.pcap"));
    }
};

TEST_F(RawlogSegmentCapture, CaptureAndRawlogGetSameLabels) {
    const auto outcome = expectSuccess(
        {"-i", captureOfRecording(), "-o", path("of_capture.rawlog"), "--kitti", path("a")});
    EXPECT_THAT(outcome.out, HasSubstr("LiDAR scans in "));
    EXPECT_THAT(outcome.out, HasSubstr("sensor velodyne: VLP-16, 16 beams"));
    EXPECT_THAT(outcome.err, HasSubstr("velodyne (VLP-16 at 10.0.0.100, port 2368): "));
    // The output contains the scans with their packets.
    expectSuccess({"-q", "-i", path("of_capture.rawlog"), "--kitti", path("b")});
    EXPECT_TRUE(labelsOf("a") == labelsOf("b"));
    EXPECT_GT(labelsOf("a").size(), 100000u);
}

TEST_F(RawlogSegmentCapture, OusterRequiresMetadata) {
    const std::string json = folder_.write("ouster.json", test::ousterJson());
    const auto sensor = sensors::readOusterSensor(json);
    const std::string capture =
        test::CaptureWriter()
            .datagrams(test::packetsOf(sensor, test::randomFrame(sensor, 1)))
            .write(path("ouster.pcap"));
    const std::string settings =
        folder_.write("four_beams.yaml", "window_size: 2\nprincipal_components: 1\n");
    const auto outcome = expectSuccess(
        {"-i", capture, "--sensor-json", json, "-o", path("out.rawlog"), "-c", settings});
    EXPECT_THAT(outcome.out, HasSubstr("sensor ouster: OS-0-32-U1, 4 beams"));
    EXPECT_THAT(outcome.err, HasSubstr("ouster (OS-0-32-U1, RNG19_RFL8_SIG16_NIR16): 4 packets"));

    const std::string cut = folder_.write("cut.json", test::ousterJson().substr(0, 200));
    const std::string other = folder_.write("other.json", test::ousterJson("LEGACY"));
    expectFailures({"-i", capture, "-o", path("other.rawlog")}, 1,
                   {{{}, "--sensor-json FILE"},
                    {{"--sensor-json", cut}, "cut.json: not Ouster metadata"},
                    {{"--sensor-json", other}, "Is it another sensor's metadata?"}});
    expectFailure({"-i", capture, "--sensor-json", path("none.json"), "-o", path("other.rawlog")},
                  2, "--sensor-json");
    expectFailure({"-i", recording(), "--sensor-json", json, "-o", path("other.rawlog")}, 1,
                  "is neither a capture");
}

TEST_F(RawlogSegmentCapture, RejectsUnsupportedCaptures) {
    const std::string capture = test::CaptureWriter()
                                    .datagrams({std::string(8448, '\0')}, 0, 7502)
                                    .write(path("ouster.pcap"));
    expectFailure({"-i", capture, "-o", path("out.rawlog")}, 1,
                  "ouster.pcap: has no data packets from a known Velodyne");
    const std::string wifi = test::CaptureWriter(105).write(path("wifi.pcap"));
    expectFailure({"-i", wifi, "-o", path("out.rawlog")}, 1, "on a link of type 105");
}

}  // namespace
}  // namespace hagen
