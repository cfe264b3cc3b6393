#include <hagen/avoidance/WorldModel.h>
#include "avoidance/world_models/UnbiasedModel.h"

#include <stdexcept>
#include "base/Text.h"

#include "avoidance/world_models/Maps.h"
#include "avoidance/world_models/WindowModel.h"

namespace hagen::avoidance {

namespace {

using TrueClearance = std::function<float(const Eigen::Vector3f&, double)>;

/// Queries the true scene.
class OracleModel : public WorldModel {
 public:
    explicit OracleModel(TrueClearance true_clearance_m)
        : true_clearance_m_(std::move(true_clearance_m)) {
        if (!true_clearance_m_) throw std::invalid_argument("the oracle needs the true clearance");
    }

    void update(const observations::MappedScan&) override {}
    float clearance_m(const Eigen::Vector3f& point_m) const override { return at(point_m, 0); }
    bool isKnown(const Eigen::Vector3f&) const override { return true; }
    std::size_t bytes() const override { return 0; }
    Obstacles obstacles() const override { return {}; }

 protected:
    float at(const Eigen::Vector3f& point_m, double after_s) const {
        return std::clamp(true_clearance_m_(point_m, after_s), 0.0f, kReach_m);
    }

 private:
    TrueClearance true_clearance_m_;
};

/// Queries the future scene, too.
class OracleOfMotion : public OracleModel {
 public:
    using OracleModel::OracleModel;
    float clearanceAfter_m(const Eigen::Vector3f& point_m, double after_s) const override {
        return at(point_m, after_s);
    }
    float fastest_m_s() const override { return 5; }  // maximum of all scenarios
};

using Factory = std::unique_ptr<WorldModel> (*)(const WorldModelSetting&);

struct Entry {
    std::string name, display_name;
    enum { AllPoints, Labels, Truth } needs;
    Factory make;  ///< with Movers, makes the map only
    /// Mean over walls and poles with equal weight, seeds 0-29; verified on seeds 100-119. Measure
    /// again when a model or its input changes.
    float distance_bias_m;
    enum { StandsStill, OwnMotion, MoversOverMap } motion = StandsStill;
};

template <bool kRoiOnly>
std::unique_ptr<WorldModel> makeWindow(const WorldModelSetting& setting) {
    return std::make_unique<WindowModel>(kRoiOnly, windowSizeFor(setting.pace));
}

template <bool kRoiOnly>
std::unique_ptr<WorldModel> makeMovingWindow(const WorldModelSetting& setting) {
    return makeWindowWithMotion(kRoiOnly, windowSizeFor(setting.pace));
}

template <observations::MapContent kContent, int kResolution_cm>
std::unique_ptr<WorldModel> makeOctoMapOf(const WorldModelSetting& setting) {
    observations::ScanMapOptions options;
    options.content = kContent;
    options.resolution_m = kResolution_cm / 100.0;
    options.max_range_m = static_cast<double>(perceptionRangeFor_m(setting.pace));
    return makeOctoMap(options, setting.bounds_m);
}

std::unique_ptr<WorldModel> makeGrid(const WorldModelSetting& setting) {
    return makeGridModel(0.2f, setting.bounds_m, perceptionRangeFor_m(setting.pace));
}

template <int kEdge_cm>
std::unique_ptr<WorldModel> makeRollingGrid(const WorldModelSetting& setting) {
    return makeRollingGridModel(kEdge_cm / 100.0f, setting.pace);
}

std::unique_ptr<WorldModel> makeDepthImageMap(const WorldModelSetting& setting) {
    return makeDepthImageModel(0.2f, setting.pace);
}

template <class Oracle>
std::unique_ptr<WorldModel> makeOracle(const WorldModelSetting& setting) {
    return std::make_unique<Oracle>(setting.true_clearance_m);
}

const std::vector<Entry>& entries() {
    static const std::vector<Entry> entries = {
        {"W-RoI", "RoI window", Entry::Labels, makeWindow<true>, -0.009f},
        {"W-RoI+motion", "RoI window with motion", Entry::Labels, makeMovingWindow<true>, -0.009f,
         Entry::OwnMotion},
        {"W-Full", "full window", Entry::AllPoints, makeWindow<false>, -0.009f},
        {"W-Full+motion", "full window with motion", Entry::Labels, makeMovingWindow<false>,
         -0.009f, Entry::OwnMotion},
        {"O-Full-0.2", "OctoMap 0.2 m", Entry::AllPoints,
         makeOctoMapOf<observations::MapContent::Full, 20>, -0.150f},
        {"O-Full-0.4", "OctoMap 0.4 m", Entry::AllPoints,
         makeOctoMapOf<observations::MapContent::Full, 40>, -0.272f},
        {"O-RoI-0.2", "RoI OctoMap 0.2 m", Entry::Labels,
         makeOctoMapOf<observations::MapContent::Roi, 20>, -0.152f},
        {"O-RoI-0.4", "RoI OctoMap 0.4 m", Entry::Labels,
         makeOctoMapOf<observations::MapContent::Roi, 40>, -0.273f},
        {"O-RoI+rays-0.2", "RoI OctoMap with all rays 0.2 m", Entry::Labels,
         makeOctoMapOf<observations::MapContent::RoiAndRays, 20>, -0.150f},
        {"O-RoI+rays-0.4", "RoI OctoMap with all rays 0.4 m", Entry::Labels,
         makeOctoMapOf<observations::MapContent::RoiAndRays, 40>, -0.272f},
        {"G-Full", "occupancy grid 0.2 m", Entry::AllPoints, makeGrid, -0.139f},
        {"G-Full+motion", "occupancy grid 0.2 m with motion", Entry::Labels, makeGrid, -0.139f,
         Entry::MoversOverMap},
        {"R-Full-0.1", "rolling grid 0.1 m", Entry::AllPoints, makeRollingGrid<10>, -0.083f},
        {"R-Full-0.2", "rolling grid 0.2 m", Entry::AllPoints, makeRollingGrid<20>, -0.150f},
        {"R-Full-0.2+motion", "rolling grid 0.2 m with motion", Entry::Labels, makeRollingGrid<20>,
         -0.150f, Entry::MoversOverMap},
        {"D-Full", "depth-image map 0.2 m", Entry::AllPoints, makeDepthImageMap, -0.161f},
        {"oracle", "true scene", Entry::Truth, makeOracle<OracleModel>, 0},
        {"oracle+motion", "true scene with motion", Entry::Truth, makeOracle<OracleOfMotion>, 0,
         Entry::OwnMotion},
    };
    return entries;
}

const Entry* findEntry(const std::string& name) {
    const auto found = std::find_if(entries().begin(), entries().end(),
                                    [&](const Entry& entry) { return entry.name == name; });
    return found == entries().end() ? nullptr : &*found;
}

const Entry& entryOf(const std::string& name) {
    if (const Entry* entry = findEntry(name)) return *entry;
    throw std::invalid_argument("unknown world model '" + name + "'; known: " + worldModelList());
}

}  // namespace

const std::vector<std::string>& worldModelNames() {
    static const std::vector<std::string> names = [] {
        std::vector<std::string> of_entries;
        for (const Entry& entry : entries()) of_entries.push_back(entry.name);
        return of_entries;
    }();
    return names;
}

std::string displayName(const std::string& model) {
    const Entry* entry = findEntry(model);
    return entry == nullptr ? model : entry->display_name;
}

std::string worldModelFrom(const std::string& text) {
    for (const Entry& entry : entries()) {
        if (base::lowerCase(entry.display_name) == base::lowerCase(text)) return entry.name;
    }
    return text;
}

std::string worldModelList() {
    std::vector<std::string> list;
    for (const Entry& entry : entries()) {
        list.push_back(entry.name + " (" + entry.display_name + ")");
    }
    return base::joined(list, ", ");
}

bool needsLabels(const std::string& model) { return entryOf(model).needs == Entry::Labels; }

bool needsTruth(const std::string& model) {
    const Entry* entry = findEntry(model);
    return entry != nullptr && entry->needs == Entry::Truth;
}

bool predictsMotion(const std::string& model) {
    const Entry* entry = findEntry(model);
    return entry != nullptr && entry->motion != Entry::StandsStill;
}

std::unique_ptr<WorldModel> makeWorldModel(const std::string& name,
                                           const WorldModelSetting& setting) {
    const Entry& entry = entryOf(name);
    std::unique_ptr<WorldModel> model = entry.make(setting);
    if (setting.distance == ModelDistance::Unbiased && entry.distance_bias_m != 0) {
        model = std::make_unique<UnbiasedModel>(std::move(model), entry.distance_bias_m);
    }
    if (entry.motion == Entry::MoversOverMap) {
        // Movers are points without voxel bias.
        return makeMapWithMotion(std::move(model), windowSizeFor(setting.pace).radius_m);
    }
    return model;
}

}  // namespace hagen::avoidance
