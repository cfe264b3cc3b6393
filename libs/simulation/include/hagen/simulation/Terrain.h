#pragma once
#include <hagen/simulation/Random.h>
#include <hagen/simulation/Shape.h>
#include <vector>

namespace hagen::simulation {

/// Parameters of a scenario's ground.
struct TerrainParameters {
    double max_slope_rad = 0.05;    ///< maximum slope of the rolling ground
    double bump_m = 0.03;           ///< amplitude of bumps and ruts a few metres long
    double roughness_m = 0.02;      ///< standard deviation of the soil height of each vertex
    double grass_m = 0.1;           ///< height of the tallest grass, which grows in patches
    double paved_half_width_m = 0;  ///< half width of a smooth band without grass along x
};

/// Rolling ground: a sum of waves with a closed-form height.
class Terrain {
 public:
    Terrain(const TerrainParameters& form, Random& random);

    double height_m(double x_m, double y_m) const;
    /// Returns the maximum height of the grass at a position.
    double grassHeight_m(double x_m, double y_m) const;
    /// Returns the ground as a rough mesh that is finer in the centre (GroundExtent).
    Shape mesh(double half_length_m, double half_width_m, double reach_m, Random& random) const;

 private:
    struct Wave {
        double kx, ky, phase, amplitude_m;
        double at(double x, double y) const;
    };
    bool isPaved(double y_m) const { return y_m * y_m < paved_m2_; }

    TerrainParameters form_;
    double paved_m2_;
    std::vector<Wave> rolling_, bumps_;
    std::vector<float> grass_m_;  ///< one value per square metre, row by row
};

}  // namespace hagen::simulation
