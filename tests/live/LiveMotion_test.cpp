#include <gtest/gtest.h>
#include <hagen/live/LiveSession.h>

#include <deque>
#include <nlohmann/json.hpp>

#include "support/CaptureWriter.h"
#include "support/Program.h"
#include "support/SimpleFirings.h"

namespace hagen::live {
namespace {

/// Three turns of a VLP-16.
class Turns : public PacketSource {
 public:
    Turns() {
        const test::SimpleScene scene = test::sceneOf({}, {{8, 3, 0.2, 6}});
        const auto packets = test::turnsOf(scene, sensors::velodyneModel("VLP-16"), 3);
        packets_.assign(packets.begin(), packets.end());
    }
    Next next(Packet& packet) override {
        if (packets_.empty()) return Next::End;
        packet.bytes.assign(packets_.front().begin(), packets_.front().end());
        packet.from_ip = 1;
        packet.arrival_s = steadyNow_s();
        packets_.pop_front();
        return Next::Packet;
    }
    bool isLive() const override { return false; }

 private:
    std::deque<std::string> packets_;
};

TEST(LiveMotion, UsesExternalMotion) {
    const test::TemporaryFolder folder;
    LiveOptions options;
    options.model = "VLP-16";
    options.stats = folder / "stats.json";
    LiveListener listener;
    std::string sensor;
    std::size_t asked = 0;
    double last_s = 0;
    listener.begin = [&](const SensorModel& model, const Options& filter) {
        EXPECT_EQ(asked, 0u);
        sensor = model.name;
        EXPECT_EQ(filter.zone_m, 20);
    };
    listener.motion = [&](double time_s) {
        EXPECT_GE(time_s, last_s);
        last_s = time_s;
        ++asked;
        SensorMotion motion;
        motion.attitude = Attitude{0.01f, -0.02f};
        return motion;
    };
    listener.counts["link"] = [&] {
        return std::vector<std::pair<std::string, std::size_t>>{{"asked", asked}};
    };
    Turns turns;
    const LiveReport report = runLive(turns, options, listener);
    EXPECT_EQ(sensor, "VLP-16");
    EXPECT_EQ(asked, report.datagrams);
    const auto json = nlohmann::json::parse(test::readFile(folder / "stats.json"));
    EXPECT_EQ(json["link"]["asked"], asked);
}

}  // namespace
}  // namespace hagen::live
