#include "convert/pictures/StagePictures.h"
#include <gmock/gmock.h>
#include <hagen/scan/Angle.h>
#include <png.h>
#include "convert/pictures/AirframePicture.h"
#include "filter/image/Posture.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "support/PaperOptions.h"
#include "support/Program.h"
#include "support/SimpleScene.h"

namespace hagen::convert {
namespace {

using testing::HasSubstr;

using test::SimpleScene;
using test::TemporaryFolder;

using Colour = std::array<std::uint8_t, 3>;
constexpr std::array<Colour, 6> kObstacles{{{0xD5, 0x5E, 0x00},
                                            {0x00, 0x72, 0xB2},
                                            {0x00, 0x9E, 0x73},
                                            {0xCC, 0x79, 0xA7},
                                            {0xE6, 0x9F, 0x00},
                                            {0x7A, 0x1F, 0x5C}}};
constexpr Colour kNearestObstacle = kObstacles[0];
constexpr Colour kRou{0xA9, 0xBC, 0xCB};
constexpr Colour kEmpty{0xE9, 0xE9, 0xE9};

const std::vector<std::string> kPictures{"overview.png", "1_depth.png",       "2_maxima.png",
                                         "3_merged.png", "4_range_angle.png", "5_smoothed.png",
                                         "6_labels.png", "7_top_view.png"};

/// A picture read from its file; row 0 is at the top.
struct Picture {
    int width = 0, height = 0;
    std::vector<std::uint8_t> rgb;

    /// Counts pixels of a colour within these fractions of width and height, from the top left.
    int count(const Colour& colour, double from_x = 0, double to_x = 1, double from_y = 0,
              double to_y = 1) const {
        int number = 0;
        for (int y = static_cast<int>(from_y * height); y < static_cast<int>(to_y * height); ++y) {
            for (int x = static_cast<int>(from_x * width); x < static_cast<int>(to_x * width);
                 ++x) {
                number += std::equal(colour.begin(), colour.end(), &rgb[3 * (y * width + x)]);
            }
        }
        return number;
    }
};

Picture readPicture(const std::filesystem::path& file) {
    png_image image{};
    image.version = PNG_IMAGE_VERSION;
    if (png_image_begin_read_from_file(&image, file.c_str()) == 0) {
        throw std::runtime_error(file.string() + ": " + image.message);
    }
    image.format = PNG_FORMAT_RGB;
    Picture picture;
    picture.width = static_cast<int>(image.width);
    picture.height = static_cast<int>(image.height);
    picture.rgb.resize(PNG_IMAGE_SIZE(image));
    if (png_image_finish_read(&image, nullptr, picture.rgb.data(), 0, nullptr) == 0) {
        throw std::runtime_error(file.string() + ": " + image.message);
    }
    return picture;
}

/// Segments a scan and draws it into its own folder.
class Drawn {
 public:
    explicit Drawn(const Scan& scan, const std::string& title = "a scene", Options options = {},
                   const SensorModel& sensor = sensorModel("VLP-16"))
        : filter_(sensor, test::numbered(options)) {
        const SegmentationResult& result = filter_.segment(scan);
        drawStages({scan, filter_.sensor(), filter_.options(), result, title}, folder_.path());
    }

    Picture picture(const std::string& name) const { return readPicture(folder_ / name); }
    std::string bytes(const std::string& name) const { return test::readFile(folder_ / name); }

 private:
    HagenFilter filter_;
    TemporaryFolder folder_;
};

Scan scanOf(const SimpleScene& scene, const char* sensor = "VLP-16") {
    return test::scanScene(scene, sensorModel(sensor), 870, {0, 0, 2}).scan;
}

/// A pole at this position in the sensor frame.
SimpleScene poleAt(double x_m, double y_m) { return test::sceneOf({}, {{x_m, y_m, 0.3, 8}}); }

// Positions of the full images and of the top view as fractions of a picture, below the legend.
constexpr double kImageTop = 0.11, kImageBottom = 0.4, kImageLeft = 0.07, kImageMiddle = 0.4913;
constexpr double kTopViewTop = 0.095, kTopViewBottom = 0.93, kTopViewMiddle = 0.528;

TEST(StagePictures, DrawEveryStage) {
    const Drawn drawn(scanOf(poleAt(9, 4)));
    for (const std::string& name : kPictures) {
        EXPECT_TRUE(kStagePictures.holds(name)) << name;
        const Picture picture = drawn.picture(name);
        EXPECT_GE(picture.width, 900) << name;
        EXPECT_LE(picture.width, 1400) << name;
        EXPECT_GE(picture.height, 300) << name;
        EXPECT_LE(picture.height, 1600) << name;
        EXPECT_LT(drawn.bytes(name).size(), 400'000u) << name;
    }
}

TEST(StagePictures, DrawGroundWithoutObstacles) {
    const Drawn drawn(scanOf({}));
    const Picture labels = drawn.picture("6_labels.png"), top = drawn.picture("7_top_view.png");
    EXPECT_EQ(labels.count(kNearestObstacle, 0, 1, kImageTop, 1), 0);
    EXPECT_GT(labels.count(kRou, 0, 1, kImageTop, 1), 20000);
    EXPECT_EQ(top.count(kNearestObstacle, 0, 1, kTopViewTop, 1), 0);
    EXPECT_GT(top.count(kRou, 0, 1, kTopViewTop, 1), 1000);
}

TEST(StagePictures, DrawLeftAndForward) {
    for (const auto& [x_m, y_m] : {std::pair{8.0, 5.0}, {-8.0, -5.0}}) {
        const Drawn drawn(scanOf(poleAt(x_m, y_m)));
        const bool is_left = y_m > 0, is_ahead = x_m > 0;
        const Picture labels = drawn.picture("6_labels.png");
        const int left = labels.count(kNearestObstacle, 0, kImageMiddle, kImageTop, kImageBottom);
        const int right = labels.count(kNearestObstacle, kImageMiddle, 1, kImageTop, kImageBottom);
        EXPECT_GT(is_left ? left : right, 200);
        EXPECT_EQ(is_left ? right : left, 0);

        const Picture top = drawn.picture("7_top_view.png");
        constexpr double kMiddle = (kTopViewTop + kTopViewBottom) / 2;
        const auto quarter = [&](bool to_left, bool ahead) {
            return top.count(kNearestObstacle, to_left ? 0 : kTopViewMiddle,
                             to_left ? kTopViewMiddle : 1, ahead ? kTopViewTop : kMiddle,
                             ahead ? kMiddle : kTopViewBottom);
        };
        EXPECT_GT(quarter(is_left, is_ahead), 5);
        EXPECT_EQ(quarter(!is_left, is_ahead), 0);
        EXPECT_EQ(quarter(is_left, !is_ahead), 0);
        EXPECT_EQ(quarter(!is_left, !is_ahead), 0);
    }
}

TEST(StagePictures, DrawLowestBeamAtBottom) {
    SimpleScene scene;  // ground only: the upper half is empty
    const Picture labels = Drawn(scanOf(scene)).picture("6_labels.png");
    constexpr double kMiddle = (0.107 + 0.409) / 2;
    EXPECT_EQ(labels.count(kRou, 0, 1, kImageTop, kMiddle), 0);
    EXPECT_GT(labels.count(kEmpty, 0, 1, kImageTop, kMiddle), 20000);
    EXPECT_GT(labels.count(kRou, 0, 1, kMiddle, kImageBottom), 20000);
}

TEST(StagePictures, ColourObstaclesConsistently) {
    SimpleScene scene = poleAt(0, 9);
    scene.poles.push_back({0, -13, 0.3, 8});
    const Drawn drawn(scanOf(scene));
    const Picture labels = drawn.picture("6_labels.png"), top = drawn.picture("7_top_view.png");
    int colours = 0;
    for (const Colour& colour : kObstacles) {
        for (const bool left : {true, false}) {
            const bool in_image =
                labels.count(colour, left ? 0 : kImageMiddle, left ? kImageMiddle : 1, kImageTop,
                             kImageBottom) > 0;
            const bool in_top_view = top.count(colour, left ? 0 : kTopViewMiddle,
                                               left ? kTopViewMiddle : 1, kTopViewTop) > 0;
            EXPECT_EQ(in_image, in_top_view);
            colours += in_image;
        }
    }
    EXPECT_GE(colours, 2);
}

TEST(StagePictures, AreReproducible) {
    const Scan scan = scanOf(poleAt(9, 4));
    const Drawn once(scan), again(scan);
    for (const std::string& name : kPictures) EXPECT_EQ(once.bytes(name), again.bytes(name));
}

TEST(StagePictures, AcceptAnyTitle) {
    const Scan scan = scanOf(poleAt(9, 4));
    const Drawn plain(scan, "");
    for (const std::string& title :
         {std::string("it's \"quoted\" \\ $HOME @x %s $\\frac$ _a^2 `x` $(x)\nsecond line"),
          std::string("Flug über Wiese, 空, not UTF-8: \xFF\xFE\xC3, zero \0 byte", 50) +
              std::string(5000, 'w')}) {
        // Except for the title, the picture is unchanged.
        EXPECT_EQ(Drawn(scan, title).picture("6_labels.png").count(kRou),
                  plain.picture("6_labels.png").count(kRou))
            << title;
    }
}

/// A circle of returns, seen by all beams.
Scan roundRoom(float radius_m) {
    const SensorModel sensor = sensorModel("VLP-16");
    Scan scan;
    for (int azimuth_deg = 0; azimuth_deg < 360; ++azimuth_deg) {
        for (const float elevation_rad : sensor.elevations_rad) {
            const auto azimuth_rad = static_cast<float>(radians(static_cast<double>(azimuth_deg)));
            scan.x_m.push_back(radius_m * std::cos(azimuth_rad));
            scan.y_m.push_back(radius_m * std::sin(azimuth_rad));
            scan.z_m.push_back(radius_m * std::tan(elevation_rad));
        }
    }
    locateBeams(sensor, scan);
    return scan;
}

TEST(StagePictures, ScaleTopViewToRoom) {
    for (const float radius_m : {3.0f, 15.0f}) {
        const Picture top = Drawn(roundRoom(radius_m)).picture("7_top_view.png");
        EXPECT_GT(top.count(kNearestObstacle, 0, 0.2, kTopViewTop, kTopViewBottom), 100);
        EXPECT_GT(top.count(kNearestObstacle, 0.85, 1, kTopViewTop, kTopViewBottom), 100);
    }
}

TEST(StagePictures, ColourNeighboursDifferently) {
    SimpleScene scene;
    constexpr int kPoles = 12;
    for (int p = 0; p < kPoles; ++p) {
        const double azimuth_rad = radians(180.0 - 360.0 * (p + 0.5) / kPoles);
        scene.poles.push_back({9 * std::cos(azimuth_rad), 9 * std::sin(azimuth_rad), 0.3, 8});
    }
    const Picture labels = Drawn(scanOf(scene)).picture("6_labels.png");
    const double width = 2 * (kImageMiddle - kImageLeft) / kPoles;
    std::size_t last = kObstacles.size();
    for (int p = 0; p < kPoles; ++p) {
        const double left = kImageLeft + p * width;
        std::vector<int> counts;
        for (const Colour& colour : kObstacles) {
            counts.push_back(labels.count(colour, left, left + width, kImageTop, kImageBottom));
        }
        const auto most = std::max_element(counts.begin(), counts.end());
        const auto own = static_cast<std::size_t>(most - counts.begin());
        EXPECT_GT(*most, 100) << p;
        EXPECT_NE(own, last) << p;
        last = own;
    }
}

TEST(StagePictures, DrawEmptyScan) {
    const Drawn drawn{Scan()};
    const Picture labels = drawn.picture("6_labels.png");
    EXPECT_EQ(labels.count(kRou, 0, 1, kImageTop, 1), 0);
    EXPECT_GT(labels.count(kEmpty, 0, 1, kImageTop, 1), 100000);
}

TEST(StagePictures, OmitNonFiniteReturns) {
    Scan scan = scanOf(poleAt(9, 4));
    for (std::size_t i = 0; i < scan.size(); i += 3) {
        scan.x_m[i] = i % 2 == 0 ? kNoValue : std::numeric_limits<float>::infinity();
    }
    scan.x_m[1] = scan.y_m[1] = scan.z_m[1] = 0.01f;  // below the minimum range
    locateBeams(sensorModel("VLP-16"), scan);
    EXPECT_NO_THROW(Drawn{scan});
}

TEST(StagePictures, RejectOtherSensor) {
    HagenFilter filter(sensorModel("VLP-16"), test::numbered({}));
    const Scan scan = scanOf(poleAt(9, 4));
    Attitude on_its_side;
    on_its_side.pitch_rad = 1.0f;
    const SegmentationResult& result = filter.segment(scan, on_its_side);
    const TemporaryFolder folder;
    EXPECT_THROW(drawStages({scan, filter.sensor(), filter.options(), result, ""}, folder.path()),
                 std::invalid_argument);
    const SensorModel sensor = sensorIn(postureOf(on_its_side, filter.sensor()), filter.sensor());
    EXPECT_NO_THROW(drawStages({scan, sensor, filter.options(), result, ""}, folder.path()));
}

/// The error message from drawing a plane into a folder.
std::string errorInto(const std::filesystem::path& folder) {
    const Scan scan = scanOf({});
    HagenFilter filter(sensorModel("VLP-16"), test::numbered({}));
    const SegmentationResult& result = filter.segment(scan);
    return test::messageOf([&] {
        drawStages({scan, filter.sensor(), filter.options(), result, ""}, folder);
    });
}

TEST(StagePictures, ReportWriteError) {
    const TemporaryFolder folder;
    // Not even root can replace a non-empty folder with a file.
    std::filesystem::create_directories(folder / "4_range_angle.png" / "something");
    const std::string error = errorInto(folder.path());
    EXPECT_THAT(error, HasSubstr((folder / "4_range_angle.png").string()));
}

TEST(AirframePicture, ShowsMaskedDirections) {
    const TemporaryFolder folder;
    Image<float> bins = Image<float>::Zero(90, 180);
    for (int row = 60; row < 75; ++row) {                                         // 30 to 60 deg up
        for (int column = 120; column < 150; ++column) bins(row, column) = 1.2f;  // to the left
    }
    drawAirframe(bins, "Peter's `drone`", folder / "airframe.png");
    const Picture picture = readPicture(folder / "airframe.png");
    const Colour farthest{0xFD, 0xE7, 0x24};
    EXPECT_GT(picture.count(farthest, 0, 0.45, 0, 0.5), 4000);
    EXPECT_EQ(picture.count(farthest, 0, 0.45, 0.5, 1), 0);
    EXPECT_EQ(picture.count(farthest, 0.45, 0.8), 0);  // left of the colour scale
    EXPECT_GT(picture.count(kEmpty), 100000);
}

TEST(AirframePicture, DrawsEmptyMask) {
    const TemporaryFolder folder;
    const Image<float> none = Image<float>::Zero(6, 12);
    drawAirframe(none, "", folder / "none.png");
    EXPECT_GT(readPicture(folder / "none.png").count(kEmpty), 100000);
    const auto missing = folder / "none/a.png";
    EXPECT_EQ(test::messageOf([&] { drawAirframe(none, "", missing); }),
              missing.string() + " could not be written: No such file or directory");
}

}  // namespace
}  // namespace hagen::convert
