#pragma once
#include <hagen/avoidance/WorldModel.h>
#include <memory>

namespace hagen {

/// MRPT's COccupancyGridMap3D of all points, and the distances to what is occupied in it
/// (dynamicEDT3D).
class GridModel : public WorldModel {
 public:
    GridModel(double resolution_m, const Eigen::AlignedBox3f& bounds_m);
    ~GridModel() override;

    void update(const MappedScan& scan) override;
    float clearance_m(const Eigen::Vector3f& point_m) const override;
    bool isKnown(const Eigen::Vector3f& point_m) const override;
    std::size_t bytes() const override;
    Obstacles obstacles() const override;

 private:
    struct Grid;
    std::unique_ptr<Grid> grid_;
};

}  // namespace hagen
