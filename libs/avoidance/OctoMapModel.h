#pragma once
#include <hagen/avoidance/WorldModel.h>
#include <hagen/mapping/ScanMap.h>
#include <memory>

namespace hagen {

/// An OctoMap, and the distances to what is occupied in it (dynamicEDT3D), kept up to date.
class OctoMapModel : public WorldModel {
 public:
    OctoMapModel(MapContent content, double resolution_m, const Eigen::AlignedBox3f& bounds_m);
    ~OctoMapModel() override;

    void update(const MappedScan& scan) override;
    float clearance_m(const Eigen::Vector3f& point_m) const override;
    bool isKnown(const Eigen::Vector3f& point_m) const override;
    std::size_t bytes() const override;
    Obstacles obstacles() const override;

 private:
    struct Distances;
    ScanMap map_;
    std::unique_ptr<Distances> distances_;
};

}  // namespace hagen
