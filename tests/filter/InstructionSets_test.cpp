// All available instruction sets give bitwise equal results for the whole filter.
#include "scan/InstructionSets.h"
#include <gtest/gtest.h>
#include <hagen/filter/HagenFilter.h>

#include <random>
#include <string>
#include <vector>

#include "support/InstructionSets.h"
#include "support/PaperOptions.h"
#include "support/SimpleScene.h"

namespace hagen {
namespace {

/// A yard with poles and walls, seen by a tilted sensor with noise and missing returns.
Scan noisyScan(const SensorModel& sensor, int columns, unsigned seed) {
    Scan scan = test::scanScene(test::yard(), sensor, columns, {0, 0, 2.1}).scan;
    std::mt19937 engine(seed);
    std::normal_distribution<float> noise_m(0, 0.02f);
    Scan kept;
    for (std::size_t i = 0; i < scan.size(); ++i) {
        if (engine() % 16 == 0) continue;
        const float scale = 1 + noise_m(engine) / scan.range_m[i];
        kept.x_m.push_back(scan.x_m[i] * scale + 0.05f * scan.z_m[i]);
        kept.y_m.push_back(scan.y_m[i] * scale);
        kept.z_m.push_back(scan.z_m[i] * scale - 0.05f * scan.x_m[i]);
        kept.intensity.push_back(0.5f);
    }
    return kept;
}

/// All bits of the filter's result.
class Bytes {
 public:
    template <class T>
    void add(const std::string& name, const T* values, std::size_t count) {
        names_.push_back(name);
        bytes_.emplace_back(reinterpret_cast<const char*>(values), count * sizeof(T));
    }
    template <class T>
    void add(const std::string& name, const Image<T>& image) {
        add(name, image.data(), static_cast<std::size_t>(image.size()));
    }
    template <class T>
    void add(const std::string& name, const std::vector<T>& values) {
        add(name, values.data(), values.size());
    }
    /// The name of the first difference; empty if there is none.
    std::string differenceFrom(const Bytes& other) const {
        for (std::size_t i = 0; i < names_.size(); ++i) {
            if (bytes_[i] != other.bytes_[i]) return names_[i];
        }
        return "";
    }

 private:
    std::vector<std::string> names_;
    std::vector<std::string> bytes_;
};

Bytes bytesOf(const Scan& scan, const SegmentationResult& r, bool has_ground) {
    Bytes bytes;
    bytes.add("range", scan.range_m);
    bytes.add("azimuth", scan.azimuth_rad);
    bytes.add("row", scan.row);
    bytes.add("depth", r.range_image.depth_m);
    bytes.add("closest return", r.range_image.closest_return);
    bytes.add("depth mapper", r.range_image.depth_mapper);
    bytes.add("repaired", r.repaired_m);
    bytes.add("proximity", r.proximity_m);
    bytes.add("maxima", r.maxima);
    bytes.add("sharpened", r.sharpened_m);
    bytes.add("merged", r.merged_m);
    bytes.add("range angle", r.range_angle_rad);
    bytes.add("smoothed", r.smoothed_rad);
    bytes.add("pixel angle", r.pixel_angle_rad);
    if (has_ground) {
        bytes.add("ground frame", r.ground.from_sensor.matrix().data(), 16);
        bytes.add("x", r.ground.pixels.x_m);
        bytes.add("y", r.ground.pixels.y_m);
        bytes.add("z", r.ground.pixels.z_m);
        bytes.add("height", r.ground.height_m);
        bytes.add("tolerance", r.ground.tolerance_m);
        bytes.add("own label", r.own_labels.label);
    }
    bytes.add("labels", r.labels);
    bytes.add("components", r.components);
    bytes.add("label", r.returns.label);
    bytes.add("component", r.returns.component);
    bytes.add("RoI", r.returns.roi);
    bytes.add("ROU", r.returns.rou);
    bytes.add("unclassified", r.returns.unclassified);
    return bytes;
}

void expectOneResult(const std::string& sensor_name, const Options& options,
                     const std::optional<Attitude>& attitude) {
    const SensorModel sensor = sensorModel(sensor_name);
    Scan scan = noisyScan(sensor, 700, 3);
    std::vector<std::pair<std::string, Bytes>> results;
    forEachInstructionSet([&](const std::string& name) {
        locateBeams(sensor, scan);
        HagenFilter filter(sensor, test::numbered(options));
        const SegmentationResult& result = filter.segment(scan, attitude);
        EXPECT_FALSE(result.returns.roi.empty());
        EXPECT_FALSE(result.maxima.empty());
        results.emplace_back(name, bytesOf(scan, result, options.ground_surface));
    });
    ASSERT_FALSE(results.empty());
    for (const auto& [name, bytes] : results) {
        EXPECT_EQ(bytes.differenceFrom(results.front().second), "")
            << name << " differs from " << results.front().first;
    }
}

TEST(InstructionSets, PaperFilterIsIdentical) {
    expectOneResult("VLP-16", test::paperOptions(), {});
    expectOneResult("HDL-32E", test::paperOptions(), {});
}

TEST(InstructionSets, DefaultFilterIsIdentical) {
    expectOneResult("VLP-16", Options(), {});
    expectOneResult("HDL-64E", Options(), Attitude{0.05f, -0.04f});
}

}  // namespace
}  // namespace hagen
