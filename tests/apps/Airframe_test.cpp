// Airframe masks in simulated flights whose LiDAR sees the vehicle.
#include <hagen/mrpt/ObservationScan.h>
#include <hagen/recordings/ScanFolder.h>
#include <hagen/simulation/ObjectClass.h>
#include "convert/RawlogWriter.h"
#include "convert/ScanFolderWriter.h"

#include <cmath>

#include "support/SegmentTest.h"

namespace hagen {
namespace {

using testing::AllOf;
using testing::HasSubstr;

/// Labels of a flight's returns: airframe, dust, and everything else.
struct Tally {
    int airframe = 0, airframe_roi = 0, airframe_unclassified = 0;
    int others = 0, others_unclassified = 0, dust_unclassified = 0;
};

struct Flight {
    std::string sensor, preset, roll_deg;
};

const Flight kVlp16{"VLP-16", "vlp16", "0"}, kMid360{"Mid-360", "mid360", "0"},
    kMid360UpsideDown{"Mid-360", "mid360", "180"};

class AirframeMask : public test::SegmentTest {
 protected:
    /// Simulates a flight as NAME.rawlog and as the folder NAME.
    void fly(const Flight& flight, const std::string& name, const std::string& seed,
             const std::string& scans) const {
        const auto outcome =
            test::run(HAGEN_RAWLOG_SIMULATE,
                      {"--scenario", "orchard", "--scans", scans, "--altitude", "2", "--seed", seed,
                       "--sensor", flight.sensor, "--mount-roll-deg", flight.roll_deg, "-o",
                       path(name + ".rawlog"), "--kitti", path(name), "-q"});
        ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    }

    Tally segmented(const std::string& name, const Flight& flight,
                    const std::vector<std::string>& more) const {
        expectSuccess(with({"-i", path(name), "--kitti", path("labels"), "--overwrite", "--stats",
                            path("stats.json"), "-c", flight.preset},
                           more));
        Tally tally;
        const recordings::ScanFolder truth(path(name)), labels(path("labels"));
        EXPECT_EQ(truth.size(), labels.size());
        for (std::size_t scan = 0; scan < truth.size(); ++scan) {
            const auto kinds = recordings::readLabels(truth.kindFile(scan));
            const auto found = recordings::readLabels(labels.labelFile(scan));
            EXPECT_EQ(kinds.size(), found.size());
            for (std::size_t i = 0; i < kinds.size(); ++i) {
                const bool is_unclassified = found[i] == 0;
                switch (static_cast<simulation::ObjectClass>(kinds[i])) {
                    case simulation::ObjectClass::Airframe:
                        ++tally.airframe;
                        tally.airframe_roi += found[i] == 2;
                        tally.airframe_unclassified += is_unclassified;
                        break;
                    case simulation::ObjectClass::Dust:
                        tally.dust_unclassified += is_unclassified;
                        break;
                    default:
                        ++tally.others;
                        tally.others_unclassified += is_unclassified;
                }
            }
        }
        return tally;
    }
};

class AirframeFlight : public AirframeMask, public testing::WithParamInterface<Flight> {};

/// Without a mask, with a learned mask, and with boxes if the sensor is upright.
TEST_P(AirframeFlight, MasksRemoveAirframeOnly) {
    fly(GetParam(), "flight", "3", "15");
    fly(GetParam(), "other", "4", "4");
    const Tally without = segmented("other", GetParam(), {});
    EXPECT_GT(without.airframe, 4 * 100);
    EXPECT_GT(without.airframe_roi, 0.95 * without.airframe);
    EXPECT_EQ(without.airframe_unclassified, 0);
    EXPECT_EQ(readJson("stats.json")["returns_masked"], 0);

    const auto learned = expectSuccess({"-i", path("flight.rawlog"), "--learn-airframe",
                                        path("airframe.yaml"), "-c", GetParam().preset});
    EXPECT_EQ(learned.err, "");
    EXPECT_THAT(learned.out, AllOf(HasSubstr("15 LiDAR scans of 'lidar'"),
                                   HasSubstr(" bins masked: "), HasSubstr(path("airframe.png"))));
    EXPECT_THAT(test::readFile(path("airframe.png")), HasSubstr("IEND"));
    const auto settings = folder_.write("drone.yaml", "airframe: [learned: airframe.yaml]");
    const Tally masked = segmented("other", GetParam(), {"-c", settings});
    EXPECT_GE(masked.airframe_unclassified, 0.99 * masked.airframe);
    EXPECT_LE(masked.others_unclassified + masked.dust_unclassified, 4 * 2);

    if (GetParam().roll_deg != "0") return;
    const Tally boxes = segmented("other", GetParam(), {"-c", config("airframe_simulated")});
    EXPECT_EQ(boxes.airframe_unclassified, boxes.airframe);
    EXPECT_EQ(boxes.others_unclassified, 0);
    EXPECT_LE(boxes.dust_unclassified, 1);
    EXPECT_EQ(readJson("stats.json")["returns_masked"], boxes.airframe + boxes.dust_unclassified);
}

INSTANTIATE_TEST_SUITE_P(Simulated, AirframeFlight,
                         testing::Values(kVlp16, kMid360, kMid360UpsideDown));
TEST_F(AirframeMask, StatisticsCountMaskedReturns) {
    const auto masked = [&](const std::string& sphere) {
        const auto mask = folder_.write("mask.yaml", "airframe: [sphere: {" + sphere + "}]");
        return expectSuccess(
            {"-i", recording(), "--stats", path("stats.json"), "--overwrite", "-c", mask});
    };
    EXPECT_THAT(masked("centre_m: [0, 0, 5], radius_m: 0.2").err,
                HasSubstr("the log: the settings' airframe masks no returns"));
    const auto outcome = masked("centre_m: [10, 0, 0], radius_m: 9");
    EXPECT_THAT(outcome.out, HasSubstr("of these: the settings' airframe"));
    EXPECT_EQ(outcome.err, "");
    const auto stats = readJson("stats.json");
    EXPECT_GT(stats["returns_masked"], 1000);
    EXPECT_EQ(stats["settings"]["airframe"]["spheres"], 1);
    int in_scans = 0;
    for (const auto& scan : stats["scans"]) {
        EXPECT_LE(scan["returns_masked"], scan["unclassified"]);
        in_scans += scan["returns_masked"].get<int>();
    }
    EXPECT_EQ(in_scans, stats["returns_masked"]);
    EXPECT_LE(stats["returns_masked"], stats["returns"]["unclassified"]);
}

TEST_F(AirframeMask, AppliesToEvaluation) {
    fly(kVlp16, "flight", "3", "3");
    const auto missed = [&](const std::string& mask) {
        const auto outcome =
            test::run(HAGEN_SEGMENTATION_EVALUATE,
                      {"-i", path("flight"), "-c", folder_.write("mask.yaml", mask), "--json",
                       path("scores.json"), "--overwrite"});
        EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
        return readJson(
                   "scores.json")["methods"][0]["drone"]["returns_above_half_metre"]["missed_share"]
            .get<double>();
    };
    EXPECT_LT(missed(""), 0.1);
    // A mask as large as the zone hides every obstacle.
    EXPECT_EQ(missed("airframe: [sphere: {centre_m: [0, 0, 0], radius_m: 20}]"), 1);
}

TEST_F(AirframeMask, LearnsEmptyMaskInOpenSpace) {
    folder_.write("a.yaml", "mine");
    const auto outcome =
        expectSuccess({"-i", recording(), "--learn-airframe", path("a.yaml"), "--overwrite"});
    EXPECT_THAT(outcome.out, HasSubstr("10 LiDAR scans of 'lidar':\n  0 bins masked"));
    EXPECT_THAT(outcome.err, HasSubstr("no mask is needed"));
    EXPECT_THAT(test::readFile(path("a.yaml")), HasSubstr("bins: []"));
    const auto settings = folder_.write("drone.yaml", "airframe: [learned: a.yaml]");
    expectSuccess({"-i", recording(), "-o", path("out"), "-c", settings});
}

TEST_F(AirframeMask, LearnsFromOneSensorOnly) {
    convert::RawlogWriter writer(path("two.rawlog"), false);
    Scan scan;
    scan.x_m = scan.y_m = scan.z_m = {0.3f};
    scan.intensity = {0};
    for (int i = 0; i < 24; ++i) {
        const std::string label = i % 2 == 0 ? "front" : "rear";
        const auto time = mrpt::Clock::fromDouble(100 + 0.05 * i);
        writer.write(*observations::observationOf(scan, label, time));
    }
    writer.commit();
    expectFailure({"-i", path("two.rawlog"), "--learn-airframe", path("a.yaml")}, 1,
                  "scans of 'front' and 'rear'");
    const auto outcome = expectSuccess(
        {"-i", path("two.rawlog"), "--learn-airframe", path("b.yaml"), "--sensor-label", "rear"});
    EXPECT_THAT(outcome.out, HasSubstr("12 LiDAR scans of 'rear':\n  1 bin masked"));
}

TEST_F(AirframeMask, RejectsInvalidArguments) {
    folder_.write("mine.yaml", "mine");
    folder_.write("b.png", "mine");
    const Arguments learn{"-i", recording(), "--learn-airframe", path("a.yaml")};
    expectFailures(learn, 1,
                   {{{"--learn-seconds", "0.5"}, "at least 10 are needed"},
                    {{"--from", "5"}, "--learn-seconds"},
                    {{"--sensor-label", "rear"}, "has 0 scans"}});
    for (const char* file : {"mine.yaml", "b.yaml"}) {  // the mask, or its picture, exists
        expectFailure({"-i", recording(), "--learn-airframe", path(file)}, 1, "--overwrite");
    }
    expectFailures(
        learn, 2,
        {{{"-o", path("out")}, "learn first"}, {{"--poses", recording()}, "does not use poses"}});
    for (const char* seconds : {"0", "-1", "nan", "soon"}) {
        expectFailure(with(learn, {"--learn-seconds", seconds}), 2, "--learn-seconds");
    }
    const auto settings = folder_.write("drone.yaml", "airframe:\n- learned: none.yaml");
    expectFailures({"-i", recording()}, 2,
                   {{{"--learn-airframe", path("a.txt")}, ".yaml"},
                    {{"-o", path("out"), "--learn-seconds", "5"}, "--learn-airframe"},
                    {{"-o", path("out"), "-c", settings}, "drone.yaml:2: "}});
    expectFailure({"--learn-airframe", path("a.yaml")}, 2, "--input");
}

}  // namespace
}  // namespace hagen
