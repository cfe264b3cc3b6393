// Simulated flights whose vehicle sees itself, and the masks against it, with the built programs.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <hagen/convert/RawlogWriter.h>
#include <hagen/convert/ScanFolderWriter.h>
#include <hagen/mrpt/ObservationScan.h>
#include <hagen/recordings/ScanFolder.h>
#include <hagen/simulation/ObjectClass.h>

#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>

#include "support/ProgramTest.h"

namespace hagen {
namespace {

using testing::AllOf;
using testing::HasSubstr;

namespace fs = std::filesystem;
const fs::path kConfig = fs::path(HAGEN_SOURCE_DIR) / "config";
const fs::path kRecording = fs::path(HAGEN_SOURCE_DIR) / "rawlogs/poles_and_wall.rawlog";

/// The low 16 bits of the numbers of a label file.
std::vector<int> numbersOf(const fs::path& file) {
    std::ifstream in(file, std::ios::binary);
    std::vector<int> numbers;
    for (std::uint32_t number = 0; in.read(reinterpret_cast<char*>(&number), sizeof number);)
        numbers.push_back(static_cast<int>(number & 0xffffu));
    return numbers;
}

/// What became of a flight's returns: those of the airframe, of dust, and of everything solid.
struct Tally {
    int airframe = 0, airframe_roi = 0, airframe_unclassified = 0;
    int others = 0, others_unclassified = 0, dust_unclassified = 0;
};

struct Flight {
    std::string sensor, preset, roll_deg;
};

const Flight kVlp16{"VLP-16", "vlp16.yaml", "0"}, kMid360{"Mid-360", "mid360.yaml", "0"},
    kMid360UpsideDown{"Mid-360", "mid360.yaml", "180"};

class AirframeMask : public test::ProgramTest {
 protected:
    test::Outcome run(const std::vector<std::string>& arguments) const override {
        return test::run(HAGEN_RAWLOG_SEGMENT, arguments);
    }

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
        const auto outcome =
            run(with({"-i", path(name), "--kitti", path("labels"), "--overwrite", "--stats",
                      path("stats.json"), "-c", kConfig / flight.preset},
                     more));
        EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
        Tally tally;
        const recordings::ScanFolder truth(path(name)), labels(path("labels"));
        EXPECT_EQ(truth.size(), labels.size());
        for (std::size_t scan = 0; scan < truth.size(); ++scan) {
            const auto kinds = numbersOf(truth.kindFile(scan));
            const auto found = numbersOf(labels.labelFile(scan));
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

    nlohmann::json stats() const {
        return nlohmann::json::parse(test::readFile(path("stats.json")));
    }
};

class AirframeFlight : public AirframeMask, public testing::WithParamInterface<Flight> {};

TEST_P(AirframeFlight, WithoutAMaskTheAirframeIsAnObstacle) {
    fly(GetParam(), "flight", "3", "4");
    const Tally tally = segmented("flight", GetParam(), {});
    EXPECT_GT(tally.airframe, 4 * 100);
    EXPECT_GT(tally.airframe_roi, 0.95 * tally.airframe);
    EXPECT_EQ(tally.airframe_unclassified, 0);
    EXPECT_EQ(stats()["returns_masked"], 0);
}

class UprightAirframe : public AirframeFlight {};

TEST_P(UprightAirframe, BoxesMaskAllOfItAndNothingElse) {
    fly(GetParam(), "flight", "3", "8");
    const Tally tally =
        segmented("flight", GetParam(), {"-c", kConfig / "airframe_simulated.yaml"});
    EXPECT_GT(tally.airframe, 8 * 100);
    EXPECT_EQ(tally.airframe_unclassified, tally.airframe);
    EXPECT_EQ(tally.others_unclassified, 0);
    EXPECT_LE(tally.dust_unclassified, 1);
    EXPECT_EQ(stats()["returns_masked"], tally.airframe + tally.dust_unclassified);
}

TEST_P(AirframeFlight, WhatWasLearnedFromOneFlightMasksTheAirframeInAnother) {
    fly(GetParam(), "one", "3", "15");
    fly(GetParam(), "other", "4", "8");
    const auto learned = run({"-i", path("one.rawlog"), "--learn-airframe", path("airframe.yaml"),
                              "-c", kConfig / GetParam().preset});
    ASSERT_EQ(learned.exit_code, 0) << learned.err;
    EXPECT_EQ(learned.err, "");
    EXPECT_THAT(learned.out, AllOf(HasSubstr("15 LiDAR scans of 'lidar'"),
                                   HasSubstr(" bins masked: "), HasSubstr(path("airframe.png"))));
    EXPECT_THAT(test::readFile(path("airframe.png")), HasSubstr("IEND"));
    const auto settings = folder_.write("drone.yaml", "airframe: [learned: airframe.yaml]");
    const Tally tally = segmented("other", GetParam(), {"-c", settings});
    EXPECT_GT(tally.airframe, 8 * 100);
    EXPECT_GE(tally.airframe_unclassified, 0.99 * tally.airframe);
    EXPECT_LE(tally.others_unclassified + tally.dust_unclassified, 8 * 2);
}

INSTANTIATE_TEST_SUITE_P(Simulated, AirframeFlight,
                         testing::Values(kVlp16, kMid360, kMid360UpsideDown));
INSTANTIATE_TEST_SUITE_P(Simulated, UprightAirframe, testing::Values(kVlp16, kMid360));

TEST_F(AirframeMask, StatisticsCountWhatIsMasked) {
    const auto mask = folder_.write("mask.yaml",
                                    "airframe: [sphere: {centre_m: [10, 0, 0], "
                                    "radius_m: 9}]");
    const auto outcome = run({"-i", kRecording, "--stats", path("stats.json"), "-c", mask});
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_THAT(outcome.out, HasSubstr("of these: the airframe"));
    EXPECT_EQ(outcome.err, "");
    const auto json = stats();
    EXPECT_GT(json["returns_masked"], 1000);
    EXPECT_EQ(json["settings"]["airframe"]["spheres"], 1);
    int masked = 0;
    for (const auto& scan : json["scans"]) {
        EXPECT_LE(scan["returns_masked"], scan["unclassified"]);
        masked += scan["returns_masked"].get<int>();
    }
    EXPECT_EQ(masked, json["returns_masked"]);
    EXPECT_LE(json["returns_masked"], json["returns"]["unclassified"]);
}

TEST_F(AirframeMask, AMaskThatMasksNothingIsRemarked) {
    const auto mask = folder_.write("mask.yaml",
                                    "airframe: [sphere: {centre_m: [0, 0, 5], "
                                    "radius_m: 0.2}]");
    const auto outcome = run({"-i", kRecording, "-o", path("out.rawlog"), "-c", mask});
    EXPECT_EQ(outcome.exit_code, 0);
    EXPECT_THAT(outcome.err, HasSubstr("the log: the airframe of the settings masks none"));
}

TEST_F(AirframeMask, TheEvaluatedFilterHasTheSameMask) {
    fly(kVlp16, "flight", "3", "3");
    const auto missed = [&](const std::string& mask) {
        const auto outcome =
            test::run(HAGEN_SEGMENTATION_EVALUATE,
                      {"-i", path("flight"), "-c", folder_.write("mask.yaml", mask), "--json",
                       path("scores.json"), "--overwrite"});
        EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
        const auto json = nlohmann::json::parse(test::readFile(path("scores.json")));
        return json["methods"][0]["drone"]["returns_above_half_metre"]["missed_share"]
            .get<double>();
    };
    EXPECT_LT(missed(""), 0.1);
    // A mask as large as the zone leaves nothing to be found.
    EXPECT_EQ(missed("airframe: [sphere: {centre_m: [0, 0, 0], radius_m: 20}]"), 1);
}

TEST_F(AirframeMask, WarnsWhereMostOfWhatIsSeenWouldBeMasked) {
    fs::create_directories(path("scans/velodyne"));
    for (int scan = 0; scan < 12; ++scan) {  // a wall all around a standing vehicle
        std::ofstream out(path("scans/velodyne/" + convert::scanName(scan) + ".bin"),
                          std::ios::binary);
        for (int azimuth_deg = 0; azimuth_deg < 360; ++azimuth_deg) {
            const auto azimuth_rad = static_cast<float>(azimuth_deg) * 0.0174533f;
            const float point[]{std::cos(azimuth_rad), std::sin(azimuth_rad), 0.02f, 0.5f};
            out.write(reinterpret_cast<const char*>(point), sizeof point);
        }
    }
    const auto outcome = run({"-i", path("scans"), "--learn-airframe", path("a.yaml")});
    EXPECT_EQ(outcome.exit_code, 0);
    EXPECT_THAT(outcome.out, HasSubstr("180 bins masked: 1.74 % of the sphere, 100.00 %"));
    EXPECT_THAT(outcome.err, HasSubstr("WARNING: more than 20 % is masked. A wall beside"));
}

TEST_F(AirframeMask, LearnsFromAFlightInTheOpenThatThereIsNothingToMask) {
    const auto outcome = run({"-i", kRecording, "--learn-airframe", path("a.yaml")});
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_THAT(outcome.out, HasSubstr("10 LiDAR scans of 'lidar':\n  0 bins masked"));
    EXPECT_THAT(outcome.err, HasSubstr("no mask is needed"));
    const auto settings = folder_.write("drone.yaml", "airframe: [learned: a.yaml]");
    EXPECT_EQ(run({"-i", kRecording, "-o", path("out"), "-c", settings}).exit_code, 0);
}

TEST_F(AirframeMask, FailsToLearnFromTooFewScans) {
    expectFailure({"-i", kRecording, "--learn-airframe", path("a.yaml"), "--learn-seconds", "0.5"},
                  1, "at least 10 are needed");
    expectFailure({"-i", kRecording, "--learn-airframe", path("a.yaml"), "--from", "5"}, 1,
                  "--learn-seconds");
}

TEST_F(AirframeMask, FailsToLearnFromSeveralSensorsOrFromOneThatIsNotThere) {
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
                  "scans of 'front' and of 'rear'");
    const auto outcome = run(
        {"-i", path("two.rawlog"), "--learn-airframe", path("b.yaml"), "--sensor-label", "rear"});
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_THAT(outcome.out, HasSubstr("12 LiDAR scans of 'rear':\n  1 bin masked"));
    expectFailure({"-i", kRecording, "--learn-airframe", path("a.yaml"), "--sensor-label", "rear"},
                  1, "has 0 scans");
}

TEST_F(AirframeMask, FailsWhereTheFileOrThePictureExists) {
    folder_.write("a.yaml", "mine");
    folder_.write("b.png", "mine");
    expectFailure({"-i", kRecording, "--learn-airframe", path("a.yaml")}, 1, "a.yaml");
    expectFailure({"-i", kRecording, "--learn-airframe", path("b.yaml")}, 1, "b.png");
    EXPECT_EQ(
        run({"-q", "-i", kRecording, "--learn-airframe", path("a.yaml"), "--overwrite"}).exit_code,
        0);
    EXPECT_THAT(test::readFile(path("a.yaml")), HasSubstr("bins: []"));
}

TEST_F(AirframeMask, RefusesFlagsThatDoNotGoWithLearning) {
    expectFailure({"-i", kRecording, "--learn-airframe", path("a.yaml"), "-o", path("out")}, 2,
                  "learn first");
    expectFailure({"-i", kRecording, "--learn-airframe", path("a.txt")}, 2, ".yaml");
    expectFailure({"-i", kRecording, "--learn-airframe", path("a.yaml"), "--poses", kRecording}, 2,
                  "needs no poses");
    expectFailure({"-i", kRecording, "-o", path("out"), "--learn-seconds", "5"}, 2,
                  "--learn-airframe");
    expectFailure({"--learn-airframe", path("a.yaml")}, 2, "--input");
    for (const char* seconds : {"0", "-1", "nan", "soon"}) {
        expectFailure(
            {"-i", kRecording, "--learn-airframe", path("a.yaml"), "--learn-seconds", seconds}, 2,
            "--learn-seconds");
    }
}

TEST_F(AirframeMask, RefusesALearnedFileThatIsNotThere) {
    const auto settings = folder_.write("drone.yaml", "airframe:\n- learned: none.yaml");
    expectFailure({"-i", kRecording, "-o", path("out"), "-c", settings}, 2, "drone.yaml:2: ");
}

}  // namespace
}  // namespace hagen
