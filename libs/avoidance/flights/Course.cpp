#include <hagen/avoidance/Course.h>
#include <hagen/avoidance/PathSearch.h>
#include <hagen/avoidance/WorldModel.h>
#include <stdexcept>

#include "avoidance/flights/CourseScenes.h"
#include "avoidance/planning/StraightWay.h"
#include "base/Text.h"

namespace hagen::avoidance {
namespace {

using Eigen::Vector3d;
using Eigen::Vector3f;
using Clearance = std::function<float(const Vector3f&)>;

/// The limits of a flight: a horizontal rectangle, from below its lowest ground to above its
/// highest.
Eigen::AlignedBox3d boundsOver(const simulation::Terrain& terrain) {
    constexpr double kLeft_m = -6, kRight_m = 46, kHalfWidth_m = 15;
    constexpr double kBelow_m = 1, kAbove_m = 6;
    Eigen::AlignedBox3d bounds;
    for (double x_m = kLeft_m; x_m <= kRight_m; x_m += 1) {
        for (double y_m = -kHalfWidth_m; y_m <= kHalfWidth_m; y_m += 1) {
            const double ground_m = terrain.height_m(x_m, y_m);
            bounds.extend(Vector3d(x_m, y_m, ground_m - kBelow_m));
            bounds.extend(Vector3d(x_m, y_m, ground_m + kAbove_m));
        }
    }
    return bounds;
}

/// The length of a path after its corners are cut where the straight line is clear. The uncut path
/// of a grid search is up to 8 % too long.
double cutLength_m(const Clearance& clearance_m, const std::vector<Vector3d>& path) {
    double length_m = 0;
    for (std::size_t i = 0; i + 1 < path.size();) {
        std::size_t next = path.size() - 1;
        while (next > i + 1 && blockedAt_m(clearance_m, path[i], path[next], kCourseClearance_m))
            --next;
        length_m += (path[next] - path[i]).norm();
        i = next;
    }
    return length_m;
}

/// The length of the shortest path found; empty if no path leads to the goal.
std::optional<double> oraclePath_m(const Course& course) {
    const Clearance clearance_m = [&](const Vector3f& at) {
        const double height_m = static_cast<double>(at.z()) -
                                course.scene.terrain().height_m(static_cast<double>(at.x()),
                                                                static_cast<double>(at.y()));
        if (height_m < kMinHeight_m || height_m > kMaxHeight_m) return 0.0f;
        return course.distance.toStatic(at);
    };
    PathSearchOptions options;
    options.bounds_m = course.bounds_m;
    options.min_clearance_m = options.wanted_clearance_m = kCourseClearance_m;
    const auto path = findPath(clearance_m, course.start_m, course.goal_m, options);
    if (!path) return std::nullopt;
    return cutLength_m(clearance_m, *path);
}

Course courseThrough(const CourseKind& kind, std::uint64_t seed, const simulation::Scene& scene) {
    const auto above = [&](const Eigen::Vector2d& at) {
        return Vector3d(at.x(), at.y(), scene.terrain().height_m(at.x(), at.y()) + kind.altitude_m);
    };
    const Eigen::AlignedBox3d bounds_m = boundsOver(scene.terrain());
    const auto reach_m = static_cast<double>(WorldModel::kReach_m);
    return {kind.name,
            seed,
            scene,
            simulation::SceneDistance(scene, bounds_m, reach_m),
            above(kCourseStart_m),
            above(kCourseGoal_m),
            kind.altitude_m,
            bounds_m,
            0};
}

const CourseKind& kindNamed(const std::string& name) {
    for (const CourseKind& kind : courseKinds()) {
        if (kind.name == name) return kind;
    }
    throw std::invalid_argument("unknown course '" + name +
                                "'; known: " + base::joined(courseNames()));
}

}  // namespace

const std::vector<std::string>& courseNames() {
    static const std::vector<std::string> names = [] {
        std::vector<std::string> made;
        for (const CourseKind& kind : courseKinds()) made.push_back(kind.name);
        return made;
    }();
    return names;
}

Course makeCourse(const std::string& scenario, std::uint64_t seed) {
    constexpr std::uint64_t kFirstStream = 100, kMaxAttempts = 50;
    const CourseKind& kind = kindNamed(scenario);
    for (std::uint64_t attempt = 0; attempt < kMaxAttempts; ++attempt) {
        Course course =
            courseThrough(kind, seed, kind.make(simulation::Random(seed, kFirstStream + attempt)));
        if (const std::optional<double> length_m = oraclePath_m(course)) {
            course.oracle_path_m = *length_m;
            return course;
        }
    }
    throw std::runtime_error("course '" + scenario + "', seed " + std::to_string(seed) +
                             ": none of " + std::to_string(kMaxAttempts) +
                             " scenes has a path; choose another seed");
}

}  // namespace hagen::avoidance
