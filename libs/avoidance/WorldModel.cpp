#include <hagen/avoidance/WorldModel.h>

#include <algorithm>
#include <stdexcept>

#include "GridModel.h"
#include "OctoMapModel.h"
#include "WindowModel.h"

namespace hagen::avoidance {

namespace {

/// Knows the true scene.
class OracleModel : public WorldModel {
 public:
    explicit OracleModel(std::function<float(const Eigen::Vector3f&)> true_clearance_m)
        : true_clearance_m_(std::move(true_clearance_m)) {
        if (!true_clearance_m_) throw std::invalid_argument("an oracle needs the true clearance");
    }

    void update(const mapping::MappedScan&) override {}
    float clearance_m(const Eigen::Vector3f& point_m) const override {
        return std::clamp(true_clearance_m_(point_m), 0.0f, kReach_m);
    }
    bool isKnown(const Eigen::Vector3f&) const override { return true; }
    std::size_t bytes() const override { return 0; }
    Obstacles obstacles() const override { return {}; }

 private:
    std::function<float(const Eigen::Vector3f&)> true_clearance_m_;
};

using Making = std::unique_ptr<WorldModel> (*)(const WorldModelSetting&);

struct Entry {
    std::string name;
    bool needs_labels;
    Making make;
};

template <bool kRoiOnly>
std::unique_ptr<WorldModel> makeWindow(const WorldModelSetting&) {
    return std::make_unique<WindowModel>(kRoiOnly);
}

template <mapping::MapContent kContent, int kResolution_cm>
std::unique_ptr<WorldModel> makeOctoMap(const WorldModelSetting& setting) {
    return std::make_unique<OctoMapModel>(kContent, kResolution_cm / 100.0, setting.bounds_m);
}

std::unique_ptr<WorldModel> makeGrid(const WorldModelSetting& setting) {
    return std::make_unique<GridModel>(0.2f, setting.bounds_m);
}

std::unique_ptr<WorldModel> makeOracle(const WorldModelSetting& setting) {
    return std::make_unique<OracleModel>(setting.true_clearance_m);
}

const std::vector<Entry>& entries() {
    static const std::vector<Entry> entries = {
        {"W-RoI", true, makeWindow<true>},
        {"W-Full", false, makeWindow<false>},
        {"O-Full-0.2", false, makeOctoMap<mapping::MapContent::Full, 20>},
        {"O-Full-0.4", false, makeOctoMap<mapping::MapContent::Full, 40>},
        {"O-RoI-0.2", true, makeOctoMap<mapping::MapContent::Roi, 20>},
        {"O-RoI-0.4", true, makeOctoMap<mapping::MapContent::Roi, 40>},
        {"O-RoI+rays-0.2", true, makeOctoMap<mapping::MapContent::RoiAndRays, 20>},
        {"O-RoI+rays-0.4", true, makeOctoMap<mapping::MapContent::RoiAndRays, 40>},
        {"G-Full", false, makeGrid},
        {"oracle", false, makeOracle},
    };
    return entries;
}

const Entry& entryOf(const std::string& name) {
    for (const Entry& entry : entries()) {
        if (entry.name == name) return entry;
    }
    std::string known;
    for (const Entry& entry : entries()) known += " " + entry.name;
    throw std::invalid_argument("no world model \"" + name + "\"; there are:" + known);
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

bool needsLabels(const std::string& model) { return entryOf(model).needs_labels; }

std::unique_ptr<WorldModel> makeWorldModel(const std::string& name,
                                           const WorldModelSetting& setting) {
    return entryOf(name).make(setting);
}

}  // namespace hagen::avoidance
