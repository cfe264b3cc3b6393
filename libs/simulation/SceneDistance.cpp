#include <hagen/simulation/SceneDistance.h>
#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "simulation/Embree.h"

namespace hagen::simulation {
namespace {

using Eigen::Vector3f;

struct Triangle {
    Vector3f a, b, c;
};

/// The convex hull of two balls, such as a part of a wire or a pole.
struct Rod {
    Vector3f from, to;
    float from_radius, to_radius;
};

struct Surfaces {
    std::vector<Triangle> triangles;
    std::vector<Rod> rods;

    std::size_t size() const { return triangles.size() + rods.size(); }
};

float toSegment2(const Vector3f& point, const Vector3f& a, const Vector3f& b) {
    const Vector3f along = b - a;
    const float length2 = along.squaredNorm();
    const float share =
        length2 > 0 ? std::clamp((point - a).dot(along) / length2, 0.0f, 1.0f) : 0.0f;
    return (point - a - share * along).squaredNorm();
}

/// Squared distance to the plane if the foot of the perpendicular lies within the triangle,
/// otherwise to the nearest edge.
float toTriangle2(const Vector3f& point, const Triangle& t) {
    const Vector3f normal = (t.b - t.a).cross(t.c - t.a);
    const auto isInside = [&](const Vector3f& from, const Vector3f& to) {
        return normal.dot((to - from).cross(point - from)) >= 0;
    };
    const float size2 = normal.squaredNorm();
    if (size2 > 0 && isInside(t.a, t.b) && isInside(t.b, t.c) && isInside(t.c, t.a)) {
        const float above = normal.dot(point - t.a);
        return above * above / size2;
    }
    return std::min(
        {toSegment2(point, t.a, t.b), toSegment2(point, t.b, t.c), toSegment2(point, t.c, t.a)});
}

/// The distance to the nearest ball of the rod; 0 inside the rod. For a point at s along and h off
/// the axis, the distance to the ball at s - u is sqrt(h^2 + u^2) - r, where r is linear in u. Its
/// derivative is 0 where u / sqrt(h^2 + u^2) equals the taper.
float toRod(const Vector3f& point, const Rod& rod) {
    const Vector3f axis = rod.to - rod.from;
    const float length = axis.norm(), widening = rod.to_radius - rod.from_radius;
    float share = widening > 0 ? 1.0f : 0.0f;  // larger ball, in case it contains the other
    if (length > std::abs(widening)) {
        const float along = (point - rod.from).dot(axis) / length;
        const float aside =
            std::sqrt(std::max(0.0f, (point - rod.from).squaredNorm() - along * along));
        const float taper = -widening / length;
        const float ahead = taper * aside / std::sqrt(1 - taper * taper);
        share = std::clamp((along - ahead) / length, 0.0f, 1.0f);
    }
    const Vector3f middle = rod.from + share * axis;
    return std::max(0.0f, (point - middle).norm() - rod.from_radius - share * widening);
}

Eigen::AlignedBox3f boxOf(const Triangle& t) {
    return Eigen::AlignedBox3f(t.a).extend(t.b).extend(t.c);
}

Eigen::AlignedBox3f boxOf(const Rod& rod) {
    const Vector3f from = Vector3f::Constant(rod.from_radius);
    const Vector3f to = Vector3f::Constant(rod.to_radius);
    return Eigen::AlignedBox3f(rod.from - from, rod.from + from)
        .merged(Eigen::AlignedBox3f(rod.to - to, rod.to + to));
}

/// Adds the parts of a transformed shape that intersect a box. Rods stay round.
void addWithin(const Eigen::AlignedBox3f& box, const Shape& shape, const Eigen::Affine3f& pose,
               Surfaces& surfaces) {
    std::vector<Vector3f> vertices;
    vertices.reserve(shape.vertices_m.size());
    for (const Vector3f& vertex : shape.vertices_m) vertices.push_back(pose * vertex);
    for (const auto& t : shape.triangles) {
        const Triangle triangle{vertices[t[0]], vertices[t[1]], vertices[t[2]]};
        if (box.intersects(boxOf(triangle))) surfaces.triangles.push_back(triangle);
    }
    const float scale = std::cbrt(std::abs(pose.linear().determinant()));
    for (const std::uint32_t first : shape.segments) {
        const Eigen::Vector4f &p = shape.polyline_m[first], &q = shape.polyline_m[first + 1];
        const Rod rod{pose * Vector3f(p.head<3>()), pose * Vector3f(q.head<3>()), scale * p.w(),
                      scale * q.w()};
        if (box.intersects(boxOf(rod))) surfaces.rods.push_back(rod);
    }
}

Eigen::AlignedBox3f boxOf(const Surfaces& surfaces, std::size_t i) {
    const std::size_t triangles = surfaces.triangles.size();
    return i < triangles ? boxOf(surfaces.triangles[i]) : boxOf(surfaces.rods[i - triangles]);
}

void setBounds(const RTCBoundsFunctionArguments* asked) {
    const auto& surfaces = *static_cast<const Surfaces*>(asked->geometryUserPtr);
    const Eigen::AlignedBox3f box = boxOf(surfaces, asked->primID);
    *asked->bounds_o = {box.min().x(), box.min().y(), box.min().z(), 0,
                        box.max().x(), box.max().y(), box.max().z(), 0};
}

/// Surfaces searched by Embree, which stores the address of this object: do not move it.
class SearchTree {
 public:
    SearchTree(RTCDevice device, Surfaces surfaces) : surfaces_(std::move(surfaces)) {
        scene_.reset(rtcNewScene(device));
        if (surfaces_.size() > 0) {
            RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_USER);
            rtcSetGeometryUserPrimitiveCount(geometry, static_cast<unsigned>(surfaces_.size()));
            rtcSetGeometryUserData(geometry, &surfaces_);
            rtcSetGeometryBoundsFunction(geometry, setBounds, nullptr);
            attach(scene_.get(), geometry);
        }
        rtcCommitScene(scene_.get());
    }
    SearchTree(const SearchTree&) = delete;
    SearchTree& operator=(const SearchTree&) = delete;

    /// Returns the distance, limited to `reach_m`.
    float distance_m(const Vector3f& point, float reach_m) const {
        Search search{&surfaces_, point, reach_m};
        RTCPointQuery query{point.x(), point.y(), point.z(), 0, reach_m};
        RTCPointQueryContext context;
        rtcInitPointQueryContext(&context);
        rtcPointQuery(scene_.get(), &query, &context, visit, &search);
        return search.nearest_m;
    }

    const Surfaces& surfaces() const { return surfaces_; }

 private:
    struct Search {
        const Surfaces* surfaces;
        Vector3f point;
        float nearest_m;
    };

    static bool visit(RTCPointQueryFunctionArguments* found) {
        auto& search = *static_cast<Search*>(found->userPtr);
        const std::vector<Triangle>& triangles = search.surfaces->triangles;
        const std::size_t i = found->primID;
        const float distance_m =
            i < triangles.size() ? std::sqrt(toTriangle2(search.point, triangles[i]))
                                 : toRod(search.point, search.surfaces->rods[i - triangles.size()]);
        if (!(distance_m < search.nearest_m)) return false;
        search.nearest_m = distance_m;
        found->query->radius = distance_m;
        return true;
    }

    Surfaces surfaces_;
    ScenePtr scene_;
};

/// A moving obstacle in its own frame, and its radius around its origin.
struct Moving {
    MovingObstacle mover;
    std::unique_ptr<SearchTree> tree;
    float radius_m = 0;
};

float radiusOf(const Surfaces& surfaces) {
    float radius_m = 0;
    for (std::size_t i = 0; i < surfaces.size(); ++i) {
        const Eigen::AlignedBox3f box = boxOf(surfaces, i);
        radius_m = std::max(radius_m, box.min().cwiseAbs().cwiseMax(box.max().cwiseAbs()).norm());
    }
    return radius_m;
}

/// True if a moving obstacle is near a point in top view. First tests the obstacle's circle.
bool isNear(const MovingObstacle& mover, const Vector3f& point, double time_s, double near_m) {
    const Eigen::Vector2d at = point.head<2>().cast<double>();
    if (std::abs((at - mover.middle_m).norm() - mover.radius_m) >= near_m) return false;
    return (at - placeOf(mover, time_s)).norm() < near_m;
}

}  // namespace

struct SceneDistance::World {
    World(const Scene& from, const Eigen::AlignedBox3d& bounds_m, double farthest_m)
        : scene(from), device(embreeDevice()), reach_m(static_cast<float>(farthest_m)) {
        const SceneContent& content = scene.content();
        const Eigen::Vector3d wider = Eigen::Vector3d::Constant(farthest_m);
        const Eigen::AlignedBox3f box(Vector3f((bounds_m.min() - wider).cast<float>()),
                                      Vector3f((bounds_m.max() + wider).cast<float>()));
        Surfaces surfaces;
        for (const SceneObject& object : content.objects) {
            if (object.kind == ObjectClass::Canopy) continue;
            addWithin(box, content.shapes.at(object.shape), object.pose, surfaces);
        }
        standing = std::make_unique<SearchTree>(device, std::move(surfaces));

        const float far = std::numeric_limits<float>::infinity();
        const Eigen::AlignedBox3f everywhere(Vector3f::Constant(-far), Vector3f::Constant(far));
        for (const MovingObstacle& mover : content.movers) {
            Surfaces own;
            addWithin(everywhere, content.shapes.at(mover.shape), Eigen::Affine3f::Identity(), own);
            const float radius_m = radiusOf(own);
            moving.push_back(
                {mover, std::make_unique<SearchTree>(device, std::move(own)), radius_m});
        }
    }

    Scene scene;
    RTCDevice device;
    float reach_m;
    std::unique_ptr<SearchTree> standing;
    std::vector<Moving> moving;
};

SceneDistance::SceneDistance(const Scene& scene, const Eigen::AlignedBox3d& bounds_m,
                             double reach_m)
    : world_(std::make_shared<World>(scene, bounds_m, reach_m)) {}

float SceneDistance::toStatic(const Eigen::Vector3f& point_m) const {
    return world_->standing->distance_m(point_m, world_->reach_m);
}

float SceneDistance::at(const Eigen::Vector3f& point_m, double time_s) const {
    float nearest_m = toStatic(point_m);
    for (const Moving& moving : world_->moving) {
        const double near_m = static_cast<double>(nearest_m + moving.radius_m);
        if (!isNear(moving.mover, point_m, time_s, near_m)) continue;
        const Eigen::Affine3f pose = poseOf(moving.mover, world_->scene.terrain(), time_s);
        const Eigen::Isometry3f rigid(pose.matrix());
        nearest_m = moving.tree->distance_m(rigid.inverse() * point_m, nearest_m);
    }
    return nearest_m;
}

}  // namespace hagen::simulation
