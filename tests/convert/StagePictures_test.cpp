#include "convert/pictures/StagePictures.h"
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <png.h>
#include "convert/pictures/AirframePicture.h"
#include "filter/image/Posture.h"

#include <array>
#include <cstdlib>
#include <fstream>
#include <functional>
#include <limits>
#include <sstream>
#include <stdexcept>

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
        : filter_(sensor, options) {
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
SimpleScene poleAt(double x_m, double y_m) {
    SimpleScene scene;
    scene.poles.push_back({x_m, y_m, 0.3, 8});
    return scene;
}

/// Sets an environment variable during its lifetime.
class Environment {
 public:
    Environment(const char* name, const std::string& value) : name_(name) {
        const char* before = std::getenv(name);
        if (before != nullptr) before_ = before;
        setenv(name, value.c_str(), 1);
    }
    ~Environment() { setenv(name_, before_.c_str(), 1); }
    Environment(const Environment&) = delete;
    Environment& operator=(const Environment&) = delete;

 private:
    const char* name_;
    std::string before_;
};

template <class Action>
std::string errorOf(Action action) {
    try {
        action();
    } catch (const std::runtime_error& e) {
        return e.what();
    }
    return "no error";
}

// Positions of the full images and of the top view as fractions of a picture, below the legend.
constexpr double kImageTop = 0.13, kImageBottom = 0.41, kImageMiddle = 0.4913;
constexpr double kTopViewTop = 0.095, kTopViewBottom = 0.93, kTopViewMiddle = 0.528;

TEST(StagePictures, DrawEveryStage) {
    const Drawn drawn(scanOf(poleAt(9, 4)));
    EXPECT_EQ(stagePictures().size(), 8u);
    for (const std::string& name : stagePictures()) {
        const Picture picture = drawn.picture(name);
        EXPECT_GE(picture.width, 900) << name;
        EXPECT_LE(picture.width, 1200) << name;
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
    constexpr double kMiddle = (0.12 + 0.41) / 2;
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
    for (const std::string& name : stagePictures()) EXPECT_EQ(once.bytes(name), again.bytes(name));
}

TEST(StagePictures, QuoteTitle) {
    const TemporaryFolder folder;
    const Scan scan = scanOf(poleAt(9, 4));
    const Drawn plain(scan, "");
    const std::string harm = "touch " + (folder / "harm").string();
    for (const std::string& title :
         {"it's \"quoted\" \\ $HOME @x %s {/:Bold b} _a^2 `" + harm + "` $(" + harm + ")",
          std::string("END_OF_DATA"), "x\nEND_OF_DATA\nsystem('" + harm + "')",
          std::string("Flug über Wiese, 空, not UTF-8: \xFF\xFE\xC3, zero \0 byte", 50) +
              std::string(5000, 'w')}) {
        const Drawn drawn(scan, title);
        // Except for the title, the picture is unchanged.
        EXPECT_EQ(drawn.picture("6_labels.png").count(kRou),
                  plain.picture("6_labels.png").count(kRou))
            << title;
    }
    EXPECT_FALSE(std::filesystem::exists(folder / "harm"));
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

TEST(StagePictures, DrawManyBeams) {
    Options options;
    options.context_m = std::numeric_limits<float>::infinity();
    options.window_size = options.principal_components = 20;
    options.persistence_m = 0.01f;
    EXPECT_NO_THROW(Drawn(scanOf(poleAt(9, 4), "HDL-64E"), "", options, sensorModel("HDL-64E")));
    options = {};
    options.columns = 90;
    options.window_size = options.principal_components = 2;
    EXPECT_NO_THROW(Drawn(scanOf(poleAt(9, 4)), "", options));
    const SensorModel few_beams = customSensorModel({-10.0, 0.0, 1.5});
    EXPECT_NO_THROW(
        Drawn(test::scanScene({}, few_beams, 90, {0, 0, 2}).scan, "", options, few_beams));
}

TEST(StagePictures, RejectOtherSensor) {
    HagenFilter filter(sensorModel("VLP-16"), {});
    const Scan scan = scanOf(poleAt(9, 4));
    Attitude on_its_side;
    on_its_side.pitch_rad = 1.0f;
    const SegmentationResult& result = filter.segment(scan, on_its_side);
    const TemporaryFolder folder;
    EXPECT_THROW(drawStages({scan, filter.sensor(), filter.options(), result, ""}, folder.path()),
                 std::invalid_argument);
    const SensorModel sensor = sensorIn(postureOf(on_its_side), filter.sensor());
    EXPECT_NO_THROW(drawStages({scan, sensor, filter.options(), result, ""}, folder.path()));
}

TEST(StagePictures, AcceptAnyAzimuth) {
    const Scan scan = scanOf(poleAt(9, 4));
    HagenFilter filter(sensorModel("VLP-16"));
    const SegmentationResult& result = filter.segment(scan);
    const TemporaryFolder folder;
    for (const float azimuth_deg : {-180.0f, 180.0f, 1e6f}) {
        EXPECT_NO_THROW(drawStages(
            {scan, filter.sensor(), filter.options(), result, "", azimuth_deg}, folder.path()));
    }
}

TEST(StagePictures, ReplaceOldPictures) {
    const TemporaryFolder folder;
    folder.write("6_labels.png", "an old one");
    const Scan scan = scanOf({});
    HagenFilter filter(sensorModel("VLP-16"));
    drawStages({scan, filter.sensor(), filter.options(), filter.segment(scan), ""}, folder.path());
    EXPECT_GT(readPicture(folder / "6_labels.png").width, 0);
}

/// The error message from drawing a plane into a folder.
std::string errorInto(const std::filesystem::path& folder) {
    const Scan scan = scanOf({});
    HagenFilter filter(sensorModel("VLP-16"));
    const SegmentationResult& result = filter.segment(scan);
    return errorOf([&] {
        drawStages({scan, filter.sensor(), filter.options(), result, ""}, folder);
    });
}

TEST(StagePictures, ReportMissingGnuplot) {
    const TemporaryFolder folder;
    const Environment path("PATH", folder.path().string());
    EXPECT_THAT(errorInto(folder.path()), HasSubstr("gnuplot-nox"));
}

TEST(StagePictures, RejectMissingFolder) {
    const TemporaryFolder folder;
    EXPECT_THAT(errorInto(folder / "none"), HasSubstr((folder / "none").string()));
}

TEST(StagePictures, ReportWriteError) {
    const TemporaryFolder folder;
    // Not even root can replace a non-empty folder with a file.
    std::filesystem::create_directories(folder / "4_range_angle.png" / "something");
    const std::string error = errorInto(folder.path());
    EXPECT_THAT(error, HasSubstr((folder / "4_range_angle.png").string()));
}

/// The error message with a script instead of gnuplot.
std::string errorWithGnuplot(const std::string& script) {
    const TemporaryFolder programs, folder;
    const auto program = programs.write("gnuplot", "#!/bin/sh\n" + script);
    std::filesystem::permissions(program, std::filesystem::perms::owner_all);
    const Environment path("PATH", programs.path().string());
    return errorInto(folder.path());
}

TEST(StagePictures, ReportTruncatedPicture) {
    // On a full disk, gnuplot succeeds but its files are incomplete.
    const std::string error = errorWithGnuplot(
        "for f in 1_depth 2_maxima; do printf '\\211PNG\\r\\n\\032\\nIHDR...' >$f.png; done\n");
    EXPECT_THAT(error, HasSubstr("1_depth.png could not be written completely"));
}

TEST(StagePictures, QuoteGnuplotErrors) {
    const std::string error =
        errorWithGnuplot("printf '\\nset x\\n    ^\\nline 1: unknown terminal\\n' >&2; exit 1\n");
    EXPECT_THAT(error, HasSubstr("unknown terminal"));
}

/// The commands for gnuplot, without the pixel data.
std::string commandsOf(const std::function<void()>& draw) {
    const TemporaryFolder programs;
    const std::string taken = (programs / "taken").string();
    const auto program = programs.write("gnuplot", "#!/bin/sh\ncat \"$2\" >'" + taken + "'\n");
    std::filesystem::permissions(program, std::filesystem::perms::owner_all);
    const Environment path("PATH", programs.path().string() + ":/usr/bin:/bin");
    errorOf(draw);  // fails, as no picture is drawn
    std::istringstream lines(test::readFile(taken));
    std::string text, end;
    for (std::string line; std::getline(lines, line);) {
        if (end.empty() || line == end) text += line + "\n";
        const std::size_t block = line.find(" << ");
        if (line == end) {
            end.clear();
        } else if (line[0] == '$' && block != std::string::npos) {
            end = line.substr(block + 4);
        }
    }
    return text;
}

/// The tests above check what a picture shows; this test pins all sizes, positions, colours and
/// texts by the FNV-1a hash of the script. After an intended change, check the pictures, then
/// update the hash.
void expectHash(std::uint64_t recorded, const std::string& commands) {
    std::uint64_t hash = 0xcbf29ce484222325;
    for (const char c : commands) hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3;
    EXPECT_EQ(hash, recorded) << commands;
}

TEST(StagePictures, MatchRecordedScript) {
    const TemporaryFolder folder;
    const Scan scan = scanOf(poleAt(9, 4));
    HagenFilter filter(sensorModel("VLP-16"));
    const SegmentationResult& result = filter.segment(scan);
    expectHash(
        0x4180830b147a9d9d, commandsOf([&] {
            drawStages({scan, filter.sensor(), filter.options(), result, "a pole"}, folder.path());
        }));
}

TEST(AirframePicture, MatchesRecordedScript) {
    const TemporaryFolder folder;
    const Image<float> bins = Image<float>::Constant(90, 180, 1.2f);
    expectHash(0x78a989772456760a,
               commandsOf([&] { drawAirframe(bins, "a drone", folder.path(), "airframe.png"); }));
}

TEST(AirframePicture, ShowsMaskedDirections) {
    const TemporaryFolder folder;
    Image<float> bins = Image<float>::Zero(90, 180);
    for (int row = 60; row < 75; ++row) {                                         // 30 to 60 deg up
        for (int column = 120; column < 150; ++column) bins(row, column) = 1.2f;  // to the left
    }
    drawAirframe(bins, "Peter's `drone`", folder.path(), "airframe.png");
    const Picture picture = readPicture(folder / "airframe.png");
    const Colour farthest{0xFD, 0xE7, 0x25};
    EXPECT_GT(picture.count(farthest, 0, 0.45, 0, 0.5), 4000);
    EXPECT_EQ(picture.count(farthest, 0, 0.45, 0.5, 1), 0);
    EXPECT_EQ(picture.count(farthest, 0.45, 0.8), 0);  // left of the colour scale
    EXPECT_GT(picture.count(kEmpty), 100000);
}

TEST(AirframePicture, DrawsEmptyMask) {
    const TemporaryFolder folder;
    const Image<float> none = Image<float>::Zero(6, 12);
    drawAirframe(none, "", folder.path(), "none.png");
    EXPECT_GT(readPicture(folder / "none.png").count(kEmpty), 100000);
    EXPECT_THAT(test::messageOf([&] { drawAirframe(none, "", folder / "none", "a.png"); }),
                HasSubstr("no such folder"));
}

}  // namespace
}  // namespace hagen::convert
