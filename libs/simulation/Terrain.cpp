#include <hagen/scan/Angle.h>
#include <hagen/simulation/Terrain.h>
#include <algorithm>
#include <cmath>

namespace hagen::simulation {
namespace {

constexpr double kCell_m = 0.6;  // mesh width in the fine centre
constexpr int kGrass_m = 150;    // extent of the grass in 1 m cells

/// Coordinates from -`reach_m` to `reach_m`: in steps of kCell_m within `half_m`, then in growing
/// steps.
std::vector<double> gridLines(double half_m, double reach_m) {
    std::vector<double> positive;
    double at = 0, step = kCell_m;
    while (at < reach_m) {
        at += step;
        if (at > half_m) step *= 1.12;
        positive.push_back(at);
    }
    std::vector<double> lines;
    for (auto line = positive.rbegin(); line != positive.rend(); ++line) lines.push_back(-*line);
    lines.push_back(0);
    lines.insert(lines.end(), positive.begin(), positive.end());
    return lines;
}

}  // namespace

double Terrain::Wave::at(double x, double y) const {
    return amplitude_m * std::sin(kx * x + ky * y + phase);
}

Terrain::Terrain(const TerrainParameters& form, Random& random)
    : form_(form), paved_m2_(form.paved_half_width_m * form.paved_half_width_m) {
    const auto wave = [&](double length_m, double amplitude_m) {
        const double heading = random.uniform(0, 2 * kPi), k = 2 * kPi / length_m;
        return Wave{k * std::cos(heading), k * std::sin(heading), random.uniform(0, 2 * kPi),
                    amplitude_m};
    };
    for (const double length_m : {110.0, 80.0, 60.0, 45.0, 32.0, 24.0, 17.0}) {
        rolling_.push_back(wave(length_m * random.uniform(0.85, 1.15), std::pow(length_m, 1.2)));
    }
    // Scales the steepest of many samples to the maximum slope.
    double steepest = 0;
    for (int i = 0; i < 4000; ++i) {
        const double x = random.uniform(-60, 60), y = random.uniform(-45, 45), d = 0.5;
        steepest = std::max(steepest, std::hypot(height_m(x + d, y) - height_m(x - d, y),
                                                 height_m(x, y + d) - height_m(x, y - d)) /
                                          (2 * d));
    }
    for (Wave& w : rolling_) w.amplitude_m *= std::tan(form.max_slope_rad) / steepest;
    for (int i = 0; i < 6; ++i) {
        bumps_.push_back(wave(random.uniform(2.5, 8.0), form.bump_m / std::sqrt(6.0 / 2.0)));
    }
    std::vector<Wave> patches;
    for (int i = 0; i < 6; ++i) patches.push_back(wave(random.uniform(3.0, 25.0), 0.3));
    for (int x = -kGrass_m; x < kGrass_m; ++x) {
        for (int y = -kGrass_m; y < kGrass_m; ++y) {
            double share = 0.4;
            for (const Wave& patch : patches) share += patch.at(x, y);
            grass_m_.push_back(static_cast<float>(form.grass_m * std::clamp(share, 0.05, 1.0)));
        }
    }
}

double Terrain::height_m(double x_m, double y_m) const {
    double height_m = 0;
    for (const Wave& wave : rolling_) height_m += wave.at(x_m, y_m);
    if (isPaved(y_m)) return height_m;
    for (const Wave& wave : bumps_) height_m += wave.at(x_m, y_m);
    return height_m;
}

double Terrain::grassHeight_m(double x_m, double y_m) const {
    if (isPaved(y_m) || !(std::abs(x_m) < kGrass_m && std::abs(y_m) < kGrass_m)) return 0;
    const auto cell = [](double at_m) { return static_cast<std::size_t>(at_m + kGrass_m); };
    return static_cast<double>(grass_m_[cell(x_m) * 2 * kGrass_m + cell(y_m)]);
}

Shape Terrain::mesh(double half_length_m, double half_width_m, double reach_m,
                    Random& random) const {
    const std::vector<double> xs = gridLines(half_length_m, reach_m);
    const std::vector<double> ys = gridLines(half_width_m, reach_m);
    Shape shape;
    for (const double x : xs) {
        for (const double y : ys) {
            const double roughness_m = isPaved(y) ? 0.2 * form_.roughness_m : form_.roughness_m;
            shape.vertices_m.emplace_back(
                static_cast<float>(x), static_cast<float>(y),
                static_cast<float>(height_m(x, y) + roughness_m * random.normal()));
        }
    }
    const auto columns = static_cast<std::uint32_t>(ys.size());
    for (std::uint32_t i = 0; i + 1 < xs.size(); ++i) {
        for (std::uint32_t j = 0; j + 1 < columns; ++j) {
            const std::uint32_t a = i * columns + j, b = a + columns;
            shape.triangles.push_back({a, b, b + 1});
            shape.triangles.push_back({a, b + 1, a + 1});
        }
    }
    return shape;
}

}  // namespace hagen::simulation
