#include <hagen/simulation/Scene.h>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "simulation/Embree.h"

namespace hagen::simulation {
namespace {

using Eigen::Vector3f;

/// Copies numbers into a buffer of a geometry. T: element type of the buffer.
template <class T, class Source, class Write>
void fillBuffer(RTCGeometry geometry, RTCBufferType type, RTCFormat format,
                const std::vector<Source>& source, Write write) {
    auto* buffer = static_cast<T*>(
        rtcSetNewGeometryBuffer(geometry, type, 0, format, sizeof(T), source.size()));
    for (std::size_t i = 0; i < source.size(); ++i) write(source[i], buffer[i]);
}

ScenePtr buildShape(RTCDevice device, const Shape& shape) {
    ScenePtr scene(rtcNewScene(device));
    if (!shape.triangles.empty()) {
        RTCGeometry mesh = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
        fillBuffer<std::array<float, 3>>(mesh, RTC_BUFFER_TYPE_VERTEX, RTC_FORMAT_FLOAT3,
                                         shape.vertices_m, [](const Vector3f& vertex, auto& to) {
                                             to = {vertex.x(), vertex.y(), vertex.z()};
                                         });
        fillBuffer<std::array<std::uint32_t, 3>>(mesh, RTC_BUFFER_TYPE_INDEX, RTC_FORMAT_UINT3,
                                                 shape.triangles,
                                                 [](const auto& from, auto& to) { to = from; });
        attach(scene.get(), mesh);
    }
    if (!shape.segments.empty()) {
        RTCGeometry rods = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_ROUND_LINEAR_CURVE);
        fillBuffer<std::array<float, 4>>(rods, RTC_BUFFER_TYPE_VERTEX, RTC_FORMAT_FLOAT4,
                                         shape.polyline_m, [](const Eigen::Vector4f& k, auto& to) {
                                             to = {k.x(), k.y(), k.z(), k.w()};
                                         });
        fillBuffer<std::uint32_t>(rods, RTC_BUFFER_TYPE_INDEX, RTC_FORMAT_UINT, shape.segments,
                                  [](std::uint32_t from, std::uint32_t& to) { to = from; });
        attach(scene.get(), rods);
    }
    rtcCommitScene(scene.get());
    return scene;
}

RTCGeometry instanceOf(RTCDevice device, RTCScene shape,
                       const std::vector<Eigen::Affine3f>& poses) {
    RTCGeometry instance = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_INSTANCE);
    rtcSetGeometryInstancedScene(instance, shape);
    rtcSetGeometryTimeStepCount(instance, static_cast<unsigned>(poses.size()));
    for (unsigned step = 0; step < poses.size(); ++step) {
        const Eigen::Matrix4f matrix = poses[step].matrix();
        rtcSetGeometryTransform(instance, step, RTC_FORMAT_FLOAT4X4_COLUMN_MAJOR, matrix.data());
    }
    return instance;
}

/// Object class and number of an instance, and the transform of normals to the map.
struct Instance {
    ObjectClass kind;
    std::uint16_t number;
    Eigen::Matrix3f normals;
};

Instance instanceOf(ObjectClass kind, std::uint16_t number, const Eigen::Affine3f& pose) {
    return {kind, number, pose.linear().inverse().transpose()};
}

/// Number of rays in an Embree packet.
constexpr int kPacket = 8;
constexpr unsigned kNoHit = RTC_INVALID_GEOMETRY_ID;

class Packet {
 public:
    Packet(const Ray* rays, int count, float max_range_m) : count_(count) {
        for (int i = 0; i < kPacket; ++i) {
            const Ray& ray = rays[std::min(i, count - 1)];
            valid_[i] = i < count ? -1 : 0;
            packet_.ray.org_x[i] = ray.origin_m.x();
            packet_.ray.org_y[i] = ray.origin_m.y();
            packet_.ray.org_z[i] = ray.origin_m.z();
            packet_.ray.dir_x[i] = ray.direction.x();
            packet_.ray.dir_y[i] = ray.direction.y();
            packet_.ray.dir_z[i] = ray.direction.z();
            packet_.ray.tnear[i] = 0;
            packet_.ray.tfar[i] = std::min(max_range_m, ray.reach_m);
            packet_.ray.time[i] = ray.time;
            packet_.ray.mask[i] = ~0u;
            packet_.ray.id[i] = 0;
            packet_.ray.flags[i] = 0;
            packet_.hit.geomID[i] = kNoHit;
            packet_.hit.instID[0][i] = kNoHit;
        }
    }

    /// Can be called for several scenes in turn; keeps the nearest hit.
    void cast(RTCScene scene, const std::vector<Instance>& instances, const Ray* rays,
              RayHit* hits) {
        castIncoherent(scene, valid_.data(), &packet_);
        for (int i = 0; i < count_; ++i) {
            if (packet_.hit.geomID[i] == kNoHit) continue;
            const Instance& instance = instances[packet_.hit.instID[0][i]];
            const Vector3f normal(packet_.hit.Ng_x[i], packet_.hit.Ng_y[i], packet_.hit.Ng_z[i]);
            const Vector3f turned = (instance.normals * normal).normalized();
            const bool is_away = turned.dot(rays[i].direction) > 0;
            hits[i] = {packet_.ray.tfar[i], instance.kind, instance.number,
                       is_away ? Vector3f(-turned) : turned};
            packet_.hit.geomID[i] = kNoHit;
        }
    }

 private:
    alignas(32) RTCRayHit8 packet_;
    alignas(32) std::array<int, kPacket> valid_;
    int count_;
};

double angleOf(const MovingObstacle& mover, double time_s) {
    return mover.phase_rad + time_s * mover.speed_m_s / mover.radius_m;
}

}  // namespace

Eigen::Vector2d placeOf(const MovingObstacle& mover, double time_s) {
    const double angle = angleOf(mover, time_s);
    return mover.middle_m + mover.radius_m * Eigen::Vector2d(std::cos(angle), std::sin(angle));
}

Eigen::Affine3f poseOf(const MovingObstacle& mover, const Terrain& terrain, double time_s) {
    const Eigen::Vector2d at = placeOf(mover, time_s);
    const double heading =
        angleOf(mover, time_s) + (mover.speed_m_s >= 0 ? 1 : -1) * 1.5707963267948966;
    const double z_m = terrain.height_m(at.x(), at.y()) + mover.above_ground_m;
    return Eigen::Translation3f(Eigen::Vector3d(at.x(), at.y(), z_m).cast<float>()) *
           Eigen::AngleAxisf(static_cast<float>(heading), Vector3f::UnitZ());
}

struct Scene::World {
    explicit World(SceneContent made) : content(std::move(made)), device(embreeDevice()) {
        for (const Shape& shape : content.shapes) shapes.push_back(buildShape(device, shape));
        scene.reset(rtcNewScene(device));
        for (const SceneObject& object : content.objects) {
            attach(scene.get(), instanceOf(device, shapes.at(object.shape).get(), {object.pose}));
            instances.push_back(instanceOf(object.kind, object.number, object.pose));
        }
        rtcCommitScene(scene.get());
    }

    SceneContent content;
    RTCDevice device;
    std::vector<ScenePtr> shapes;
    ScenePtr scene;
    std::vector<Instance> instances;  ///< indexed by Embree's instance ID
};

struct Scene::Snapshot::Movers {
    ScenePtr scene;
    std::vector<Instance> instances;
};

Scene::Scene(SceneContent content) : world_(std::make_shared<World>(std::move(content))) {}

const SceneContent& Scene::content() const { return world_->content; }

Scene::Snapshot Scene::snapshotOver(double start_s, double duration_s) const {
    Snapshot snapshot;
    snapshot.world_ = world_;
    if (content().movers.empty()) return snapshot;
    auto movers = std::make_shared<Snapshot::Movers>();
    RTCDevice device = world_->device;
    movers->scene.reset(rtcNewScene(device));
    for (const MovingObstacle& mover : content().movers) {
        const Eigen::Affine3f from = poseOf(mover, terrain(), start_s);
        const Eigen::Affine3f to = poseOf(mover, terrain(), start_s + duration_s);
        attach(movers->scene.get(),
               instanceOf(device, world_->shapes.at(mover.shape).get(), {from, to}));
        movers->instances.push_back(instanceOf(ObjectClass::Mover, mover.number, from));
    }
    rtcCommitScene(movers->scene.get());
    snapshot.movers_ = std::move(movers);
    return snapshot;
}

void Scene::Snapshot::cast(const std::vector<Ray>& rays, float max_range_m,
                           std::vector<RayHit>& hits) const {
    hits.assign(rays.size(), RayHit{std::numeric_limits<float>::quiet_NaN()});
    for (std::size_t first = 0; first < rays.size(); first += kPacket) {
        const int count = static_cast<int>(std::min<std::size_t>(kPacket, rays.size() - first));
        Packet packet(&rays[first], count, max_range_m);
        packet.cast(world_->scene.get(), world_->instances, &rays[first], &hits[first]);
        if (movers_ != nullptr) {
            packet.cast(movers_->scene.get(), movers_->instances, &rays[first], &hits[first]);
        }
    }
}

}  // namespace hagen::simulation
