#include <gtest/gtest.h>
#include <hagen/simulation/SceneDistance.h>

#include <cmath>

#include "simulation/SimpleContent.h"

namespace hagen::simulation {
namespace {

using Eigen::Vector3f;
using test::emptyContent;
using test::plane;
using test::put;
using test::sceneOf;

const Eigen::AlignedBox3d kBounds(Eigen::Vector3d(-10, -10, -10), Eigen::Vector3d(10, 10, 10));

/// The minimum of a convex function on [0, 1].
template <class Function>
double leastOf(const Function& function) {
    double low = 0, high = 1;
    for (int i = 0; i < 45; ++i) {
        const double a = low + (high - low) / 3, b = high - (high - low) / 3;
        (function(a) < function(b) ? high : low) = function(a) < function(b) ? b : a;
    }
    return function(0.5 * (low + high));
}

/// Distance by search over all points of the triangle.
double plainToTriangle(const Eigen::Vector3d& p, const Eigen::Vector3d& a, const Eigen::Vector3d& b,
                       const Eigen::Vector3d& c) {
    return leastOf([&](double u) {
        return leastOf(
            [&](double v) { return (a + u * (b - a) + (1 - u) * v * (c - a) - p).norm(); });
    });
}

double plainToRod(const Eigen::Vector3d& p, const Eigen::Vector4d& from,
                  const Eigen::Vector4d& to) {
    return std::max(0.0, leastOf([&](double share) {
                        const Eigen::Vector4d ball = from + share * (to - from);
                        return (p - ball.head<3>()).norm() - ball.w();
                    }));
}

/// Distance to the surfaces of all standing objects.
double plainDistance(const SceneContent& content, const Eigen::Vector3d& p, double reach_m) {
    double nearest = reach_m;
    for (const SceneObject& object : content.objects) {
        const Shape& shape = content.shapes[object.shape];
        const auto at = [&](const Vector3f& v) {
            return Eigen::Vector3d((object.pose * v).cast<double>());
        };
        for (const auto& t : shape.triangles) {
            nearest = std::min(
                nearest, plainToTriangle(p, at(shape.vertices_m[t[0]]), at(shape.vertices_m[t[1]]),
                                         at(shape.vertices_m[t[2]])));
        }
        for (const std::uint32_t s : shape.segments) {
            Eigen::Vector4d from, to;
            from << at(shape.polyline_m[s].head<3>()), static_cast<double>(shape.polyline_m[s].w());
            to << at(shape.polyline_m[s + 1].head<3>()),
                static_cast<double>(shape.polyline_m[s + 1].w());
            nearest = std::min(nearest, plainToRod(p, from, to));
        }
    }
    return nearest;
}

Vector3f somewhere(Random& random, double half_m) {
    const double x = random.uniform(-half_m, half_m), y = random.uniform(-half_m, half_m);
    const double z = random.uniform(-half_m, half_m);
    return Eigen::Vector3d(x, y, z).cast<float>();
}

TEST(SceneDistanceTest, MatchesGeometry) {
    SceneContent content = emptyContent();
    Shape wall, pole, ball;
    wall.addBox({5, -4, 0}, {5.3f, 4, 6});
    pole.addRod({{0, 4, -1, 0.2f}, {0, 4, 5, 0.1f}});
    ball.addRod({{-4, 0, 2, 0.5f}, {-4, 0, 2, 0.3f}});  // the smaller ball is inside the larger
    put(content, ObjectClass::Wall, 1, wall);
    put(content, ObjectClass::Pole, 2, pole);
    put(content, ObjectClass::Mover, 3, ball);
    const SceneDistance distance(Scene(std::move(content)), kBounds, 3.0);
    EXPECT_NEAR(distance.at({3, 0, 2}, 0), 2, 1e-5);
    EXPECT_NEAR(distance.at({5.15f, 0, 7}, 0), 1, 1e-5);
    EXPECT_NEAR(distance.at({4, 5, 2}, 0), std::sqrt(2.0), 1e-5);                 // an edge
    EXPECT_NEAR(distance.at({0, 3, 5.2f}, 0), std::hypot(1.0, 0.2) - 0.1, 1e-3);  // upper ball
    EXPECT_EQ(distance.at({0, 4.05f, 2}, 0), 0);
    EXPECT_NEAR(distance.at({-4, 0, 4}, 0), 1.5, 1e-5);
    EXPECT_EQ(distance.at({-2, -7, 2}, 0), 3.0f);
}

TEST(SceneDistanceTest, IgnoresCanopy) {
    const Scene scene = sceneOf(ObjectClass::Canopy, 0, plane());
    EXPECT_EQ(SceneDistance(scene, kBounds, 3.0).at({0, 0, 1}, 0), 3.0f);
}

TEST(SceneDistanceTest, IncludesSurfacesBeyondBounds) {
    Shape wall;
    wall.addBox({12, -1, -1}, {13, 1, 1});
    const Scene scene = sceneOf(ObjectClass::Wall, 1, wall);
    EXPECT_NEAR(SceneDistance(scene, kBounds, 3.0).at({10, 0, 0}, 0), 2, 1e-5);
}

TEST(SceneDistanceTest, MatchesBruteForce) {
    for (std::uint64_t seed = 1; seed <= 5; ++seed) {
        Random random(seed);
        SceneContent content = emptyContent();
        for (int i = 0; i < 12; ++i) {
            Shape shape;
            const Vector3f at = somewhere(random, 8), b = somewhere(random, 2);
            const Vector3f c = somewhere(random, 2), from = somewhere(random, 2);
            const auto thick = static_cast<float>(random.uniform(0.01, 0.8));
            const auto thin = static_cast<float>(random.uniform(0.01, 0.8));
            shape.addTriangle({0, 0, 0}, b, c);
            shape.addRod({{from.x(), from.y(), from.z(), thick}, {b.x(), b.y(), b.z(), thin}});
            const auto yaw = static_cast<float>(random.uniform(0, 6));
            put(content, ObjectClass::Tree, 1, shape,
                Eigen::Translation3f(at) * Eigen::AngleAxisf(yaw, Vector3f::UnitZ()));
        }
        const SceneDistance distance(Scene(content), kBounds, 4.0);
        for (int i = 0; i < 25; ++i) {
            const Vector3f point = somewhere(random, 10);
            ASSERT_NEAR(distance.at(point, 0), plainDistance(content, point.cast<double>(), 4.0),
                        2e-4)
                << "seed " << seed;
        }
    }
}

TEST(SceneDistanceTest, FollowsMovers) {
    SceneContent content = emptyContent();
    Shape ball;
    ball.addRod({{0, 0, 0, 0.5f}, {0, 0, 0.1f, 0.5f}});
    content.shapes.push_back(ball);
    MovingObstacle mover;
    mover.number = 1;
    mover.radius_m = 4;
    mover.speed_m_s = 2;
    mover.above_ground_m = 1;
    content.movers.push_back(mover);
    const SceneDistance distance(Scene(content), kBounds, 3.0);
    for (const double time_s : {0.0, 0.7, 5.0}) {
        const double angle = 2.0 * time_s / 4.0;
        const Eigen::Vector3d at(
            4 * std::cos(angle), 4 * std::sin(angle),
            content.terrain.height_m(4 * std::cos(angle), 4 * std::sin(angle)) + 1);
        const Eigen::Vector3d below = at - Eigen::Vector3d(0, 0, 1.5);
        EXPECT_NEAR(distance.at(below.cast<float>(), time_s), 1.0, 1e-4) << time_s;
        EXPECT_EQ(distance.at(below.cast<float>(), time_s + 3), 3.0f) << time_s;
    }
}

}  // namespace
}  // namespace hagen::simulation
