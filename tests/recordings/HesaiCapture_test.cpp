#include <hagen/scan/Angle.h>
#include <hagen/sensors/LidarDriver.h>

#include "support/CaptureTest.h"
#include "support/Datagrams.h"
#include "support/HesaiPackets.h"
#include "support/ReadBag.h"

namespace hagen::recordings {
namespace {

using testing::HasSubstr;

struct HesaiMode {
    const char* model;
    int channels, returns;
};

class HesaiCaptureTest : public test::CaptureTest, public testing::WithParamInterface<HesaiMode> {
 protected:
    /// Packets of 2.5 turns that start before azimuth 0.
    std::vector<std::string> packets() const {
        const auto [model, channels, returns] = GetParam();
        return test::hesaiPackets(channels, returns, 625 * returns, 35900);
    }
};
INSTANTIATE_TEST_SUITE_P(Modes, HesaiCaptureTest,
                         testing::Values(HesaiMode{"XT32", 32, 1}, HesaiMode{"XT32", 32, 2},
                                         HesaiMode{"XT16", 16, 1}, HesaiMode{"XT16", 16, 2}));

TEST_P(HesaiCaptureTest, ReadsKnownGeometry) {
    const auto [model, channels, returns] = GetParam();
    const Scans scans = read(test::CaptureWriter().datagrams(packets(), 2e-4).bytes());
    ASSERT_EQ(scans.size(), 4u);  // before azimuth 0, two turns, and the remainder
    std::size_t all = 0;
    for (const auto& scan : scans) {
        const auto observed = observedOf(*scan);
        EXPECT_EQ(observed.sensor.name, model);
        const Scan& found = observed.scan;
        all += found.size();
        for (std::size_t i = 0; i < found.size(); ++i) {
            const double azimuth_rad = static_cast<double>(found.azimuth_rad[i]);
            const int channel = channels - 1 - found.row[i];
            const double elevation_rad = radians(15.0 - channel * (channels == 32 ? 1 : 2));
            const double range_m = test::hesaiRange_m(channel, -degrees(azimuth_rad));
            const double level_m = range_m * std::cos(elevation_rad);
            ASSERT_NEAR(found.range_m[i], range_m, 0.0021);
            ASSERT_NEAR(found.x_m[i], level_m * std::cos(azimuth_rad), 0.0021);
            ASSERT_NEAR(found.y_m[i], level_m * std::sin(azimuth_rad), 0.0021);
            ASSERT_NEAR(found.z_m[i], range_m * std::sin(elevation_rad), 0.0021);
        }
    }
    EXPECT_EQ(all, 625u * returns * 8 * channels);
    const Scan turn = observedOf(*scans[1]).scan;
    EXPECT_EQ(turn.time_s.front(), 0);
    EXPECT_NEAR(turn.time_s.back(), 0.1, 1e-3);
    EXPECT_NEAR(turn.time_s[channels - 1], 31 * 1.512e-6, 2e-6);
}

TEST_P(HesaiCaptureTest, BagEqualsCapture) {
    const auto sent = packets();
    const Scans scans = read(test::CaptureWriter().datagrams(sent, 2e-4).bytes());
    const auto file = test::writeBytes(
        folder_ / "a.bag", test::ros1BagOf({test::hesaiMessage("/hesai", 1, "hesai", sent, 2e-4)}));
    const auto bag = test::readBag(file);
    ASSERT_EQ(bag.failed_because, "");
    ASSERT_EQ(bag.observations.size(), scans.size());
    for (std::size_t i = 0; i < scans.size(); ++i) {
        EXPECT_EQ(bag.observations[i]->sensorLabel, "hesai");
        EXPECT_EQ(observedOf(*bag.observations[i]).scan.x_m, observedOf(*scans[i]).scan.x_m);
    }
}

TEST_P(HesaiCaptureTest, CountsLostAndDuplicatePackets) {
    auto sent = packets();
    sent.erase(sent.begin() + 100, sent.begin() + 103);
    sent.insert(sent.begin() + 50, sent[49]);
    read(test::CaptureWriter().datagrams(sent, 2e-4).datagram({"other"}).bytes());
    EXPECT_THAT(remarks_[0], HasSubstr(GetParam().model + std::string(" at 10.0.0.100)")));
    EXPECT_THAT(remarks_[0], HasSubstr(" packets in 4 turns, 3 packets lost, 1 duplicate packet"));
    EXPECT_THAT(remarks_[1], HasSubstr("ignored: 1 other UDP datagram"));
}

struct Sweeps : sensors::ReturnSink {
    std::vector<sensors::Sweep> all;
    std::size_t returns = 0;
    void add(Scan& scan, const sensors::Sweep& sweep, double) override {
        all.push_back(sweep);
        returns += scan.size();
    }
    void addFrame(Scan&, const Frame&) override {}
    void flush() override {}
    void restart() override {}
};

TEST_P(HesaiCaptureTest, LiveSweepsAdjoin) {
    const auto [model, channels, returns] = GetParam();
    const auto driver = sensors::makeDriver(model);
    auto sent = packets();
    sent.erase(sent.begin() + 3);
    sent.push_back(sent[10]);           // more than 16 packets late
    sent.push_back(sent[0].substr(1));  // another size
    sent.push_back(sent.front());
    sent.back()[13] = '\xff';  // azimuth beyond 360 degrees
    Sweeps sweeps;
    for (std::size_t i = 0; i < sent.size(); ++i) {
        driver->add(test::datagramOf(sent[i]), 2e-4 * static_cast<double>(i), sweeps);
    }
    const std::size_t count = sent.size() - 3;
    ASSERT_EQ(sweeps.all.size(), count);
    EXPECT_EQ(sweeps.returns, count * 8 * channels);
    for (std::size_t i = 1; i < count; ++i) {
        const double lost_rad = i == 3 ? radians(0.18 * 8 / returns) : 0;
        ASSERT_NEAR(sweeps.all[i].from_rad, sweeps.all[i - 1].to_rad + lost_rad, 1e-9) << i;
    }
    EXPECT_EQ(driver->counts().lost, 1u);
    EXPECT_EQ(driver->counts().unsound, 1u);
    EXPECT_EQ(driver->counts().wrong_size, 1u);
    EXPECT_EQ(driver->counts().scans, 3u);
    EXPECT_EQ(driver->isDual(), returns == 2);
}

}  // namespace
}  // namespace hagen::recordings
