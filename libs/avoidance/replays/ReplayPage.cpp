#include <hagen/avoidance/WorldModel.h>
#include <cctype>
#include <cmath>
#include <map>
#include <sstream>
#include "avoidance/replays/Replay.h"
#include "avoidance/replays/ReplayTexts.h"
#include "base/Json.h"
#include "base/NumberText.h"
#include "base/view/ViewPage.h"

namespace hagen::avoidance {
namespace {

using base::Json;

/// Pages store coordinates as 16-bit centimetres from the start, up to 327 m.
constexpr double kUnit_m = 0.01;
constexpr double kShapeUnit_m = 0.005;    // for shapes, up to 164 m
constexpr double kTurnUnit_rad = 0.0001;  // covers more than half a turn

class PageWriter {
 public:
    explicit PageWriter(const FlightRecording& recording) : recording_(recording) {}

    Json head(const std::string& heading) {
        const Run& run = recording_.run;
        Json times = Json::array(), events = Json::array();
        for (const RecordedStep& step : recording_.steps) times.push_back(step.time_s);
        for (const RecordedEvent& event : recording_.events) {
            events.push_back({{"time_s", event.time_s}, {"what", event.what}});
        }
        std::string ending = recording_.ending;
        if (!ending.empty()) ending[0] = static_cast<char>(std::toupper(ending[0]));
        Json notes = {{{"text", ending}, {"is_alarm", run.result.outcome != Outcome::Success}}};
        if (!recording_.is_same) {
            notes.push_back({{"text",
                              "Flown again, the result differs from the table: another version or "
                              "machine?"},
                             {"is_alarm", true}});
        }
        return {{"format", "hagen-view-1"},
                {"heading", heading},
                {"notes", notes},
                {"events", events},
                {"unit_m", kUnit_m},
                {"ground_m", rounded(recording_.ground_m - recording_.start_m.z())},
                {"frame_times_s", times},
                {"charts", charts()},
                {"flight", flight()}};
    }

    std::vector<std::string> frames() const {
        std::vector<std::string> texts;
        for (const RecordedStep& step : recording_.steps) texts.push_back(frame(step).dump());
        return texts;
    }

 private:
    using Numbers = std::vector<std::int16_t>;

    /// What changes from moment to moment, and what never changes.
    Json flight() {
        const Run& run = recording_.run;
        Numbers track, speeds, clearances, lives, middles;
        for (const RecordedMoment& moment : recording_.track) {
            add(moment.at_m, track);
            speeds.push_back(base::roundedTo<std::int16_t>(moment.speed_m_s / kUnit_m));
            clearances.push_back(base::roundedTo<std::int16_t>(moment.clearance_m / kUnit_m));
        }
        for (const ModelCell& cell : recording_.model) {
            add(cell.centre_m, middles);
            lives.push_back(base::roundedTo<std::int16_t>(cell.from_step));
            lives.push_back(base::roundedTo<std::int16_t>(cell.until_step));
        }
        arrays_.add("track", track);
        arrays_.add("speeds", speeds);
        arrays_.add("clearances", clearances);
        arrays_.add("middles", middles);
        arrays_.add("lives", lives);
        Json json = {{"scenario", run.scenario},
                     {"seed", run.seed},
                     {"model_name", displayName(run.setup.model)},
                     {"model_edge_m", recording_.model_edge_m},
                     {"outcome", nameOf(run.result.outcome)},
                     {"control_step_s", kControlStep_s},
                     {"goal_m", fromStart(recording_.goal_m)},
                     {"radius_m", run.setup.limits.radius_m},
                     {"scene", scene()}};
        json.update(arrays_.json());
        return json;
    }

    Json charts() const {
        Json times = Json::array(), clearances = Json::array(), speeds = Json::array();
        for (std::size_t i = 0; i < recording_.track.size(); ++i) {
            times.push_back(rounded(static_cast<double>(i) * kControlStep_s));
            clearances.push_back(rounded(recording_.track[i].clearance_m));
            speeds.push_back(rounded(recording_.track[i].speed_m_s));
        }
        return {{{"label", "clearance [m]"}, {"times_s", times}, {"values", clearances}},
                {{"label", "speed [m/s]"}, {"times_s", times}, {"values", speeds}}};
    }

    /// Each shape once, and the poses of its instances.
    Json scene() {
        const TrueScene& scene = recording_.scene;
        Json shapes = Json::array(), things = Json::array(), movers = Json::array();
        for (const simulation::Shape& shape : scene.shapes) {
            const std::string name = "shape" + std::to_string(shapes.size());
            arrays_.add(name, cornersOf(shape));
            shapes.push_back(name);
        }
        std::map<std::pair<std::size_t, simulation::ObjectClass>, Json> poses;
        for (const simulation::SceneObject& object : scene.objects) {
            poses[{object.shape, object.kind}].push_back(json(object.pose));
        }
        for (const auto& [what, places] : poses) {
            things.push_back({{"shape", what.first},
                              {"kind", simulation::nameOf(what.second)},
                              {"poses", places}});
        }
        for (const TrueScene::Mover& mover : scene.movers) {
            const std::string name = "mover" + std::to_string(movers.size());
            arrays_.add(name, placesOf(mover.poses));
            movers.push_back({{"shape", mover.shape}, {"poses", name}});
        }
        Numbers heights;
        for (const double height_m : scene.ground.heights_m) {
            heights.push_back(
                base::roundedTo<std::int16_t>((height_m - recording_.start_m.z()) / kUnit_m));
        }
        arrays_.add("ground", heights, true);
        return {{"unit_m", kShapeUnit_m},
                {"shapes", shapes},
                {"things", things},
                {"mover_step_s", TrueScene::kMoverStep_s},
                {"turn_unit_rad", kTurnUnit_rad},
                {"movers", movers},
                {"ground",
                 {{"x_m", rounded(scene.ground.min_m.x() - recording_.start_m.x())},
                  {"y_m", rounded(scene.ground.min_m.y() - recording_.start_m.y())},
                  {"step_m", scene.ground.step_m},
                  {"along_x", scene.ground.along_x},
                  {"along_y", scene.ground.along_y}}}};
    }

    /// The corners of a shape's triangles, in its own frame.
    static Numbers cornersOf(const simulation::Shape& shape) {
        Numbers numbers;
        for (const auto& triangle : shape.triangles) {
            for (const std::uint32_t corner : triangle) {
                for (int axis = 0; axis < 3; ++axis) {
                    numbers.push_back(base::roundedTo<std::int16_t>(
                        static_cast<double>(shape.vertices_m[corner][axis]) / kShapeUnit_m));
                }
            }
        }
        return numbers;
    }

    /// The pose as three rows of four numbers.
    Json json(const Eigen::Affine3f& pose) const {
        Json rows = Json::array();
        for (int row = 0; row < 3; ++row) {
            for (int column = 0; column < 4; ++column) {
                const auto value = static_cast<double>(pose(row, column));
                rows.push_back(rounded(column < 3 ? value : value - recording_.start_m[row]));
            }
        }
        return rows;
    }

    /// Positions and headings, alternating.
    Numbers placesOf(const std::vector<Eigen::Affine3f>& poses) const {
        Numbers numbers;
        for (const Eigen::Affine3f& pose : poses) {
            add(Eigen::Vector3f(pose.translation()), numbers);
            const double heading_rad =
                std::atan2(static_cast<double>(pose(1, 0)), static_cast<double>(pose(0, 0)));
            numbers.push_back(base::roundedTo<std::int16_t>(heading_rad / kTurnUnit_rad));
        }
        return numbers;
    }

    template <class Point>
    void add(const Point& at, Numbers& numbers) const {
        for (int axis = 0; axis < 3; ++axis) {
            const double from_start_m = static_cast<double>(at[axis]) - recording_.start_m[axis];
            numbers.push_back(base::roundedTo<std::int16_t>(from_start_m / kUnit_m));
        }
    }
    Json fromStart(const Eigen::Vector3d& at) const {
        const Eigen::Vector3d from_start_m = at - recording_.start_m;
        return {rounded(from_start_m.x()), rounded(from_start_m.y()), rounded(from_start_m.z())};
    }

    Json frame(const RecordedStep& step) const {
        Numbers xyz, path, ways, sizes;
        std::vector<std::uint8_t> labels(step.roi_m.size(), 2);
        labels.resize(step.roi_m.size() + step.rou_m.size(), 1);
        for (const Eigen::Vector3f& at : step.roi_m) add(at, xyz);
        for (const Eigen::Vector3f& at : step.rou_m) add(at, xyz);
        for (const Eigen::Vector3f& at : step.path_m) add(at, path);
        for (const RecordedMotion& motion : step.motions) {
            for (const Eigen::Vector3f& at : motion.path_m) add(at, ways);
            const auto points = static_cast<std::int16_t>(motion.path_m.size());
            sizes.push_back(motion.is_free ? points : static_cast<std::int16_t>(-points));
        }
        base::ViewArrays arrays;
        arrays.add("xyz", xyz);
        arrays.add("label", labels);
        arrays.add("path", path);
        arrays.add("ways", ways);
        arrays.add("way_sizes", sizes);  // negative: not free
        Json json = {{"latency_ms", rounded(step.latency_ms)},
                     {"carrot_m", fromStart(step.carrot_m)},
                     {"command_m_s",
                      {rounded(step.command_m_s.x()), rounded(step.command_m_s.y()),
                       rounded(step.command_m_s.z())}},
                     {"is_emergency", step.is_emergency},
                     {"model_size", step.model_size}};
        json.update(arrays.json());
        return json;
    }

    static double rounded(double value) { return std::round(1000 * value) / 1000; }

    const FlightRecording& recording_;
    base::ViewArrays arrays_;
};

/// The heading: scenario, seed, model, guidance, speed, non-default conditions, outcome.
std::string headingOf(const Run& run) {
    const TrialSetup& setup = run.setup;
    std::string text = run.scenario + ", seed " + std::to_string(run.seed) + ", " +
                       displayName(setup.model) + ", " +
                       (setup.guidance == "astar" ? "A*" : setup.guidance) + ", " +
                       base::shortestText(setup.speed_m_s) + " m/s";
    const auto add = [&](bool deviates, const std::string& what) {
        if (deviates) text += ", " + what;
    };
    add(setup.planner != "primitives", "planner " + setup.planner);
    add(setup.pose_error != PoseError::None, "pose " + nameOf(setup.pose_error));
    add(setup.latency_scale != 1, "latency x" + base::shortestText(setup.latency_scale));
    add(setup.brakes_in_known_space, "brakes in known space");
    add(setup.air != Air::Dusty, nameOf(setup.air) + " air");
    add(setup.distance != ModelDistance::Unbiased, "distances as stored");
    add(setup.updates != Updates::Scans, nameOf(setup.updates));
    return text + ": " + nameOf(run.result.outcome);
}

}  // namespace

std::string replayPage(const FlightRecording& recording) {
    PageWriter writer(recording);
    std::ostringstream page;
    base::writeViewPage(page, writer.head(headingOf(recording.run)), writer.frames(),
                        texts::flight_js);
    return page.str();
}

}  // namespace hagen::avoidance
