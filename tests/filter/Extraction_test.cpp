#include <gtest/gtest.h>
#include <hagen/filter/Extraction.h>
#include "filter/FilterWorkspace.h"

#include <cmath>
#include <limits>
#include <map>
#include <string>

#include "support/InstructionSets.h"
#include "support/Random.h"

namespace hagen {
namespace {

FilterWorkspace work;  // reused, as in a filter

OwnLabels ownLabels(const std::vector<Label>& label) {
    OwnLabels own{label, {}};
    for (std::size_t i = 0; i < label.size(); ++i) {
        if (label[i] != Label::Unclassified) own.returns.push_back(static_cast<std::int32_t>(i));
    }
    return own;
}

/// Implements the definition return by return.
LabelledReturns plainReturns(const Scan& scan, const RangeImage& image, const Image<Label>& labels,
                             const Image<std::int32_t>& components,
                             const std::vector<Label>& own_label, float zone_m,
                             float component_gap_m) {
    LabelledReturns returns;
    std::map<std::int32_t, std::int32_t> numbers;
    for (std::uint32_t i = 0; i < scan.size(); ++i) {
        const float range_m = scan.range_m[i];
        const std::int32_t pixel = image.depth_mapper[i];
        const Label own = own_label.empty() ? Label::Unclassified : own_label[i];
        Label label = Label::Unclassified;
        std::int32_t component = 0;
        if (range_m > 0 && std::isfinite(range_m)) {
            label = range_m > zone_m ? Label::Rou : Label::Roi;
            const bool has_pixel = pixel != RangeImage::kNoPixel;
            const Label of_pixel = has_pixel ? labels.data()[pixel] : Label::Roi;
            const bool is_rou = (own != Label::Unclassified ? own : of_pixel) == Label::Rou;
            if (is_rou) label = Label::Rou;
            if (label == Label::Roi && has_pixel &&
                (own == Label::Unclassified ||
                 range_m - image.depth_m.data()[pixel] < component_gap_m)) {
                component = components.data()[pixel];
            }
        }
        returns.label.push_back(label);
        returns.component.push_back(component);
        if (component > 0) numbers[component] = 0;
        (label == Label::Roi   ? returns.roi
         : label == Label::Rou ? returns.rou
                               : returns.unclassified)
            .push_back(i);
    }
    std::int32_t number = 0;
    for (auto& [component, without_gaps] : numbers) without_gaps = ++number;
    for (std::int32_t& component : returns.component) {
        if (component > 0) component = numbers[component];
    }
    return returns;
}

TEST(Extraction, MatchesDefinitionOnEveryInstructionSet) {
    test::Random random(23);
    const SensorModel sensor = sensorModel("VLP-16");
    const float specials_m[] = {0.0f, 1e-6f, 20.0f, std::numeric_limits<float>::infinity()};
    LabelledReturns returns;  // reused, as in the filter
    for (int round = 0; round < 200; ++round) {
        const int size = random.chance(0.3) ? 64 * random.whole(0, 3) : random.whole(0, 500);
        const int columns = random.whole(3, 40);
        Scan scan;
        std::vector<Label> own_label;
        const bool has_own = random.chance(0.5);
        for (int i = 0; i < size; ++i) {
            for (auto* values : {&scan.x_m, &scan.y_m, &scan.z_m}) values->push_back(0.0f);
            scan.range_m.push_back(random.chance(0.05) ? kNoValue : random.real(0.0f, 140.0f));
            if (random.chance(0.7)) scan.range_m.back() = random.real(1.0f, 25.0f);
            if (random.chance(0.05)) scan.range_m.back() = specials_m[random.whole(0, 3)];
            scan.azimuth_rad.push_back(random.real(-3.1f, 3.1f));
            scan.row.push_back(static_cast<std::uint8_t>(random.whole(0, 15)));
            if (has_own) own_label.push_back(static_cast<Label>(random.whole(0, 2)));
        }
        RangeImage image;
        projectScan(scan, sensor, columns, random.real(10.0f, 100.0f), image, work.projection);
        Image<Label> labels(16, columns);
        Image<std::int32_t> components(16, columns);
        for (int pixel = 0; pixel < labels.size(); ++pixel) {
            labels.data()[pixel] = static_cast<Label>(random.whole(0, 2));
            components.data()[pixel] = random.whole(0, 60);
        }
        const auto expected = plainReturns(scan, image, labels, components, own_label, 20.0f, 1.0f);
        forEachInstructionSet([&](const std::string& name) {
            SCOPED_TRACE(name + ", returns: " + std::to_string(size));
            const OwnLabels own_labels = ownLabels(own_label);
            extractReturns(scan, image, labels, own_labels, 20.0f, returns, work.extraction);
            numberReturns(scan, image, components, own_labels, 1.0f, returns, work.components);
            ASSERT_EQ(returns.label, expected.label);
            ASSERT_EQ(returns.component, expected.component);
            ASSERT_EQ(returns.roi, expected.roi);
            ASSERT_EQ(returns.rou, expected.rou);
            ASSERT_EQ(returns.unclassified, expected.unclassified);
        });
        if (HasFatalFailure()) return;
    }
}

}  // namespace
}  // namespace hagen
