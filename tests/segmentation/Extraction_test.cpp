#include <gtest/gtest.h>
#include <hagen/segmentation/Extraction.h>

#include <limits>

namespace hagen {
namespace {

/// Six returns in two pixels of a 2 x 8 image, and out of it.
struct Example {
    SensorModel sensor = customSensorModel({-1, 1});
    Scan scan;
    RangeImage image;
    Image<Label> labels = Image<Label>::Constant(2, 8, Label::Unclassified);
    Image<std::int32_t> components = Image<std::int32_t>::Zero(2, 8);
    LabelledReturns returns;

    Example() {
        const auto add = [&](float range_m, std::uint8_t row) {
            scan.x_m.push_back(range_m);
            scan.range_m.push_back(range_m);
            scan.azimuth_rad.push_back(0.1f);
            scan.row.push_back(row);
        };
        add(5.0f, 0);
        add(15.0f, 0);
        add(25.0f, 0);
        add(6.0f, 1);
        add(0.1f, 1);    // nearer than the sensor sees
        add(500.0f, 1);  // farther
        add(kNoValue, 1);
        projectScan(scan, sensor, 8, 1000.0f, image);
        labels.data()[image.depth_mapper[0]] = Label::Roi;
        labels.data()[image.depth_mapper[3]] = Label::Rou;
        components.data()[image.depth_mapper[0]] = 7;
        extractReturns(scan, sensor, image, labels, components, {}, 20.0f, 1.0f, returns);
    }
};

TEST(Extraction, EveryReturnTakesItsPixelsLabelAndComponent) {
    const Example example;
    EXPECT_EQ(example.returns.label[0], Label::Roi);
    EXPECT_EQ(example.returns.label[1], Label::Roi);  // farther, in the same pixel
    EXPECT_EQ(example.returns.label[3], Label::Rou);
    EXPECT_EQ(example.returns.component, (std::vector<std::int32_t>{1, 1, 0, 0, 0, 0, 0}));
}

TEST(Extraction, ComponentsAreNumberedWithoutGapsInTheirOrder) {
    Example example;
    example.labels.data()[example.image.depth_mapper[3]] = Label::Roi;
    example.components.data()[example.image.depth_mapper[3]] = 3;  // before the other, 7
    extractReturns(example.scan, example.sensor, example.image, example.labels, example.components,
                   {}, 20.0f, 1.0f, example.returns);
    EXPECT_EQ(example.returns.component, (std::vector<std::int32_t>{2, 2, 0, 1, 0, 0, 0}));
}

TEST(Extraction, WhatTheImageDoesNotReachIsRou) {
    Example example;
    projectScan(example.scan, example.sensor, 8, 10.0f, example.image);  // cut before the zone
    extractReturns(example.scan, example.sensor, example.image, example.labels, example.components,
                   {}, 20.0f, 1.0f, example.returns);
    EXPECT_EQ(example.returns.label[0], Label::Roi);
    EXPECT_EQ(example.returns.label[1], Label::Rou);
}

TEST(Extraction, ALabelOfItsOwnOverrulesThePixels) {
    Example example;
    const auto extracted = [&](const std::vector<Label>& own_label) {
        extractReturns(example.scan, example.sensor, example.image, example.labels,
                       example.components, own_label, 20.0f, 1.0f, example.returns);
        return example.returns;
    };
    std::vector<Label> own_label(7, Label::Unclassified);
    EXPECT_EQ(extracted(own_label).label, Example().returns.label);
    own_label[1] = Label::Rou;
    EXPECT_EQ(extracted(own_label).roi, (std::vector<std::uint32_t>{0}));
    EXPECT_EQ(example.returns.rou, (std::vector<std::uint32_t>{1, 2, 3}));
    EXPECT_EQ(example.returns.component[1], 0);
    own_label[3] = Label::Roi;
    EXPECT_EQ(extracted(own_label).roi, (std::vector<std::uint32_t>{0, 3}));
    EXPECT_EQ(example.returns.component[3], 0);  // its pixel is of no component
    own_label[2] = own_label[4] = Label::Roi;    // beyond the zone, nearer than the sensor sees
    EXPECT_EQ(extracted(own_label).label[2], Label::Rou);
    EXPECT_EQ(example.returns.label[4], Label::Unclassified);
}

TEST(Extraction, WhatIsSeenPastAnObstacleIsOfNoComponent) {
    Example example;  // its second return is 10 m behind the first, of component 7
    const std::vector<Label> own_label(7, Label::Roi);
    const auto component = [&](float component_gap_m) {
        extractReturns(example.scan, example.sensor, example.image, example.labels,
                       example.components, own_label, 20.0f, component_gap_m, example.returns);
        EXPECT_EQ(example.returns.label[1], Label::Roi);
        return example.returns.component[1];
    };
    EXPECT_EQ(component(10.01f), 1);
    EXPECT_EQ(component(10.0f), 0);
    EXPECT_EQ(component(1.0f), 0);
    EXPECT_EQ(example.returns.component[0], 1);
}

TEST(Extraction, BeyondTheZoneIsRouWhateverThePixelSays) {
    const Example example;
    EXPECT_EQ(example.returns.label[2], Label::Rou);
}

TEST(Extraction, OutOfTheSensorsRangeIsUnclassified) {
    const Example example;
    EXPECT_EQ(example.returns.unclassified, (std::vector<std::uint32_t>{4, 5, 6}));
}

TEST(Extraction, EveryReturnIsInExactlyOneList) {
    const Example example;
    EXPECT_EQ(example.returns.roi, (std::vector<std::uint32_t>{0, 1}));
    EXPECT_EQ(example.returns.rou, (std::vector<std::uint32_t>{2, 3}));
}

}  // namespace
}  // namespace hagen
