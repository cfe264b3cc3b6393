#include "base/WriteFile.h"
#include "mrpt/MrptScene.h"

#include <algorithm>
#include <array>

#include "avoidance/replays/Replay.h"

namespace hagen::avoidance {
namespace {

using namespace observations::viz;
using mrpt::img::TColor;
using observations::Scene;

CPointCloud::Ptr cloudOf(const std::vector<Eigen::Vector3f>& points_m, const TColor& color,
                         float size, const std::string& name) {
    const auto cloud = CPointCloud::Create();
    for (const Eigen::Vector3f& p : points_m) cloud->insertPoint(p.x(), p.y(), p.z());
    cloud->setColor_u8(color);
    cloud->setPointSize(size);
    cloud->setName(name);
    return cloud;
}

observations::VisualObject::Ptr voxelsOf(const std::vector<Eigen::Vector3f>& centres_m,
                                         float edge_m) {
    const auto voxels = COctoMapVoxels::Create();
    voxels->resizeVoxelSets(1);
    voxels->setName("obstacles of the model");
    for (const Eigen::Vector3f& p : centres_m) {
        voxels->push_back_Voxel(
            0, COctoMapVoxels::TVoxel({p.x(), p.y(), p.z()}, edge_m, TColor(230, 159, 0)));
    }
    voxels->showVoxels(0, true);
    voxels->setVisualizationMode(COctoMapVoxels::FIXED);
    const float e = 0.5f * edge_m;
    Eigen::Vector3f low(0, 0, 0), high(0, 0, 0);
    if (!centres_m.empty()) low = high = centres_m[0];
    for (const Eigen::Vector3f& p : centres_m) {
        low = low.cwiseMin(p);
        high = high.cwiseMax(p);
    }
    voxels->setBoundingBox({low.x() - e, low.y() - e, low.z() - e},
                           {high.x() + e, high.y() + e, high.z() + e});
    return voxels;
}

CSphere::Ptr sphereAt(const Eigen::Vector3d& at, float radius_m, const TColor& color,
                      const std::string& name) {
    const auto sphere = CSphere::Create(radius_m);
    sphere->setLocation(at.x(), at.y(), at.z());
    sphere->setColor_u8(color);
    sphere->setName(name);
    return sphere;
}

/// The ground as a wire grid.
CSetOfLines::Ptr linesOf(const TrueScene::Ground& ground) {
    const auto lines = CSetOfLines::Create();
    const auto corner = [&](int i, int j) {
        return mrpt::math::TPoint3D(ground.min_m.x() + i * ground.step_m,
                                    ground.min_m.y() + j * ground.step_m,
                                    ground.heights_m[std::size_t(j * ground.along_x + i)]);
    };
    for (int j = 0; j < ground.along_y; ++j) {
        for (int i = 0; i < ground.along_x; ++i) {
            if (i > 0) lines->appendLine({corner(i - 1, j), corner(i, j)});
            if (j > 0) lines->appendLine({corner(i, j - 1), corner(i, j)});
        }
    }
    lines->setColor_u8(TColor(200, 200, 200));
    lines->setName("ground");
    return lines;
}

CSetOfLines::Ptr trackOf(const std::vector<RecordedMoment>& track) {
    const auto lines = CSetOfLines::Create();
    for (std::size_t i = 1; i < track.size(); ++i) {
        const Eigen::Vector3d &a = track[i - 1].at_m, &b = track[i].at_m;
        lines->appendLine(a.x(), a.y(), a.z(), b.x(), b.y(), b.z());
    }
    lines->setColor_u8(TColor(0, 114, 178));
    lines->setLineWidth(3);
    lines->setName("path flown");
    return lines;
}

/// The model's obstacles at the last step.
std::vector<Eigen::Vector3f> lastOf(const FlightRecording& recording) {
    const int last = static_cast<int>(recording.steps.size());
    std::vector<Eigen::Vector3f> centres_m;
    for (const ModelCell& cell : recording.model) {
        if (cell.until_step == last) centres_m.push_back(cell.centre_m);
    }
    return centres_m;
}

void addShape(const simulation::Shape& shape, const Eigen::Affine3f& pose, const TColor& color,
              CSetOfTriangles& all) {
    for (const auto& corners : shape.triangles) {
        std::array<mrpt::math::TPoint3Df, 3> at;
        for (std::size_t i = 0; i < 3; ++i) {
            const Eigen::Vector3f p = pose * shape.vertices_m[corners[i]];
            at[i] = {p.x(), p.y(), p.z()};
        }
        TTriangle triangle(at[0], at[1], at[2]);
        triangle.setColor(color);
        all.insertTriangle(triangle);
    }
}

/// The true scene, with movers at their final poses.
CSetOfTriangles::Ptr trueSceneOf(const FlightRecording& recording) {
    const TColor standing(110, 130, 105), moving(170, 60, 60);
    const TrueScene& scene = recording.scene;
    const auto all = CSetOfTriangles::Create();
    for (const simulation::SceneObject& object : scene.objects) {
        addShape(scene.shapes[object.shape], object.pose, standing, *all);
    }
    const double end_s = kControlStep_s * static_cast<double>(recording.track.size() - 1);
    for (const TrueScene::Mover& mover : scene.movers) {
        addShape(scene.shapes[mover.shape], poseAt(mover, end_s), moving, *all);
    }
    all->setName("true scene");
    return all;
}

}  // namespace

void writeReplayScene(const FlightRecording& recording, const std::filesystem::path& place,
                      const std::filesystem::path& file) {
    base::openToWrite(place, file);  // MRPT does not report write errors
    Scene scene;
    scene.insert(linesOf(recording.scene.ground));
    if (!recording.scene.shapes.empty()) scene.insert(trueSceneOf(recording));
    const std::vector<Eigen::Vector3f> held_m = lastOf(recording);
    if (recording.model_edge_m > 0) {
        scene.insert(voxelsOf(held_m, recording.model_edge_m));
    } else {
        scene.insert(cloudOf(held_m, TColor(230, 159, 0), 4, "obstacles of the model"));
    }
    if (!recording.steps.empty()) {
        const RecordedStep& last = recording.steps.back();
        scene.insert(cloudOf(last.rou_m, TColor(120, 120, 120), 2, "last scan: other returns"));
        scene.insert(cloudOf(last.roi_m, TColor(213, 94, 0), 3, "last scan: regions of interest"));
    }
    scene.insert(trackOf(recording.track));
    const auto radius_m = static_cast<float>(recording.run.setup.limits.radius_m);
    scene.insert(sphereAt(recording.start_m, 0.2f, TColor(0, 114, 178), "start"));
    scene.insert(sphereAt(recording.goal_m, 0.4f, TColor(0, 158, 115), "goal"));
    if (!recording.track.empty()) {
        scene.insert(
            sphereAt(recording.track.back().at_m, radius_m, TColor(86, 180, 233), "vehicle"));
    }
    if (!scene.saveToFile(place.string())) base::throwWriteError(file, 0);
}

}  // namespace hagen::avoidance
