#pragma once
#include <hagen/simulation/Random.h>
#include <hagen/simulation/Shape.h>
#include <vector>

namespace hagen::simulation {

/// What a scenario asks of its ground.
struct TerrainForm {
    double max_slope_rad = 0.05;    ///< of the rolling
    double bump_m = 0.03;           ///< amplitude of bumps and ruts a few metres long
    double roughness_m = 0.02;      ///< standard deviation of the soil from vertex to vertex
    double grass_m = 0.1;           ///< height of the tallest grass; it is patchy
    double paved_half_width_m = 0;  ///< a band along x that is even and has no grass
};

/// Rolling ground: a sum of waves, so that its height is known at any place.
class Terrain {
 public:
    Terrain(const TerrainForm& form, Random& random);

    double height_m(double x_m, double y_m) const;
    /// How tall grass stands there.
    double grassHeight_m(double x_m, double y_m) const;
    /// The ground as a mesh with roughness: fine in the middle (`half_length_m` by `half_width_m`
    /// about the origin), coarse out to `reach_m`.
    Shape mesh(double half_length_m, double half_width_m, double reach_m, Random& random) const;

 private:
    struct Wave {
        double kx, ky, phase, amplitude_m;
        double at(double x, double y) const;
    };
    bool isPaved(double y_m) const { return y_m * y_m < paved_m2_; }

    TerrainForm form_;
    double paved_m2_;
    std::vector<Wave> rolling_, bumps_;
    std::vector<float> grass_m_;  ///< a square metre after the other
};

}  // namespace hagen::simulation
