#include <hagen/avoidance/WorldModel.h>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>
#include "avoidance/replays/Replay.h"
#include "avoidance/replays/ReplayTexts.h"
#include "base/Json.h"
#include "base/NumberText.h"

namespace hagen::avoidance {
namespace {

using base::Json;

/// 16-bit integers, little-endian, embedded in pages as base64.
class PackedNumbers {
 public:
    /// Rounds the value and clamps it to 16 bits.
    void add(double value);
    std::string text() const;

 private:
    std::vector<std::uint8_t> bytes_;
};

void PackedNumbers::add(double value) {
    const auto whole =
        static_cast<std::int16_t>(std::lround(std::fmax(-32768, std::fmin(32767, value))));
    bytes_.push_back(static_cast<std::uint8_t>(whole & 0xff));
    bytes_.push_back(static_cast<std::uint8_t>((whole >> 8) & 0xff));
}

std::string PackedNumbers::text() const {
    constexpr char kDigits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text;
    text.reserve((bytes_.size() + 2) / 3 * 4);
    for (std::size_t i = 0; i < bytes_.size(); i += 3) {
        const std::size_t left = std::min<std::size_t>(3, bytes_.size() - i);
        std::uint32_t group = 0;
        for (std::size_t k = 0; k < 3; ++k) group = (group << 8) | (k < left ? bytes_[i + k] : 0u);
        for (std::size_t digit = 0; digit < 4; ++digit) {
            text += digit <= left ? kDigits[(group >> (18 - 6 * digit)) & 63u] : '=';
        }
    }
    return text;
}

std::string filled(std::string_view page, const std::map<std::string, std::string_view>& values) {
    std::string text;
    for (;;) {
        const std::size_t begin = page.find("{{");
        if (begin == std::string_view::npos) return text.append(page);
        const std::size_t end = page.find("}}", begin);
        const std::string name(page.substr(begin + 2, end - begin - 2));
        const auto value = values.find(name);
        if (value == values.end()) throw std::logic_error("the page has no value for " + name);
        text.append(page.substr(0, begin)).append(value->second);
        page.remove_prefix(end + 2);
    }
}

std::string scriptText(std::string json) {
    // In a string, "</script>" would end the element, and "<!--<script>" would hide its end. JSON
    // contains '<' only in strings.
    const std::string escaped = "\\u003c";
    for (std::size_t at = 0; (at = json.find('<', at)) != std::string::npos; at += escaped.size())
        json.replace(at, 1, escaped);
    return json;
}

/// Pages store coordinates as 16-bit centimetres from the start, up to 327 m.
constexpr double kUnit_m = 0.01;
constexpr double kShapeUnit_m = 0.005;    // for shapes, up to 164 m
constexpr double kTurnUnit_rad = 0.0001;  // covers more than half a turn

class PageWriter {
 public:
    explicit PageWriter(const FlightRecording& recording) : recording_(recording) {}

    Json data() const {
        Json data = head();
        addTrack(data);
        data["scene"] = scene();
        PackedNumbers lives;
        std::vector<Eigen::Vector3f> middles;
        for (const ModelCell& cell : recording_.model) {
            middles.push_back(cell.centre_m);
            lives.add(cell.from_step);
            lives.add(cell.until_step);
        }
        data["model"] = {{"edge_m", recording_.model_edge_m},
                         {"middles", points(middles)},
                         {"lives", lives.text()}};
        data["steps"] = Json::array();
        for (const RecordedStep& step : recording_.steps) data["steps"].push_back(json(step));
        data["events"] = Json::array();
        for (const RecordedEvent& event : recording_.events) {
            data["events"].push_back({{"time_s", event.time_s}, {"what", event.what}});
        }
        return data;
    }

 private:
    Json head() const {
        const Run& run = recording_.run;
        return {
            {"scenario", run.scenario},
            {"seed", run.seed},
            {"model_name", displayName(run.setup.model)},
            {"guidance", run.setup.guidance},
            {"speed_m_s", run.setup.speed_m_s},
            {"outcome", nameOf(run.result.outcome)},
            {"ending", recording_.ending},
            {"is_same", recording_.is_same},
            {"unit_m", kUnit_m},
            {"control_step_s", kControlStep_s},
            {"start_m", {recording_.start_m.x(), recording_.start_m.y(), recording_.start_m.z()}},
            {"ground_m", rounded(recording_.ground_m - recording_.start_m.z())},
            {"goal", points(std::vector<Eigen::Vector3d>{recording_.goal_m})},
            {"radius_m", run.setup.limits.radius_m}};
    }

    void addTrack(Json& data) const {
        PackedNumbers places, speeds, clearances;
        for (const RecordedMoment& moment : recording_.track) {
            add(moment.at_m, places);
            speeds.add(moment.speed_m_s / kUnit_m);
            clearances.add(moment.clearance_m / kUnit_m);
        }
        data["track"] = places.text();
        data["speeds"] = speeds.text();
        data["clearances"] = clearances.text();
    }

    /// Each shape once, and the poses of its instances.
    Json scene() const {
        const TrueScene& scene = recording_.scene;
        Json shapes = Json::array(), things = Json::array(), movers = Json::array();
        for (const simulation::Shape& shape : scene.shapes) shapes.push_back(cornersOf(shape));
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
            movers.push_back({{"shape", mover.shape}, {"poses", json(mover.poses)}});
        }
        return {{"unit_m", kShapeUnit_m},
                {"shapes", shapes},
                {"things", things},
                {"mover_step_s", TrueScene::kMoverStep_s},
                {"turn_unit_rad", kTurnUnit_rad},
                {"movers", movers},
                {"ground", json(scene.ground)}};
    }

    /// The corners of a shape's triangles, in its own frame.
    static std::string cornersOf(const simulation::Shape& shape) {
        PackedNumbers numbers;
        for (const auto& triangle : shape.triangles) {
            for (const std::uint32_t corner : triangle) {
                for (int axis = 0; axis < 3; ++axis) {
                    numbers.add(static_cast<double>(shape.vertices_m[corner][axis]) / kShapeUnit_m);
                }
            }
        }
        return numbers.text();
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
    std::string json(const std::vector<Eigen::Affine3f>& poses) const {
        PackedNumbers numbers;
        for (const Eigen::Affine3f& pose : poses) {
            add(Eigen::Vector3f(pose.translation()), numbers);
            const double heading_rad =
                std::atan2(static_cast<double>(pose(1, 0)), static_cast<double>(pose(0, 0)));
            numbers.add(heading_rad / kTurnUnit_rad);
        }
        return numbers.text();
    }

    Json json(const TrueScene::Ground& ground) const {
        PackedNumbers heights;
        for (const double height_m : ground.heights_m) {
            heights.add((height_m - recording_.start_m.z()) / kUnit_m);
        }
        return {{"x_m", rounded(ground.min_m.x() - recording_.start_m.x())},
                {"y_m", rounded(ground.min_m.y() - recording_.start_m.y())},
                {"step_m", ground.step_m},
                {"along_x", ground.along_x},
                {"along_y", ground.along_y},
                {"heights", heights.text()}};
    }

    template <class Point>
    void add(const Point& at, PackedNumbers& numbers) const {
        for (int axis = 0; axis < 3; ++axis) {
            const double from_start_m = static_cast<double>(at[axis]) - recording_.start_m[axis];
            numbers.add(from_start_m / kUnit_m);
        }
    }
    template <class Point>
    std::string points(const std::vector<Point>& all) const {
        PackedNumbers numbers;
        for (const Point& at : all) add(at, numbers);
        return numbers.text();
    }

    Json json(const RecordedStep& step) const {
        PackedNumbers ways;
        Json sizes = Json::array();
        for (const RecordedMotion& motion : step.motions) {
            for (const Eigen::Vector3f& at : motion.path_m) add(at, ways);
            const int points = static_cast<int>(motion.path_m.size());
            sizes.push_back(motion.is_free ? points : -points);  // negative: not free
        }
        return {{"time_s", step.time_s},
                {"latency_ms", rounded(step.latency_ms)},
                {"carrot", points(std::vector<Eigen::Vector3d>{step.carrot_m})},
                {"command_m_s",
                 {rounded(step.command_m_s.x()), rounded(step.command_m_s.y()),
                  rounded(step.command_m_s.z())}},
                {"emergency", step.is_emergency},
                {"model_size", step.model_size},
                {"roi", points(step.roi_m)},
                {"rou", points(step.rou_m)},
                {"path", points(step.path_m)},
                {"ways", ways.text()},
                {"way_sizes", sizes}};
    }

    static double rounded(double value) { return std::round(1000 * value) / 1000; }

    const FlightRecording& recording_;
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

/// Escapes text for an HTML element.
std::string htmlText(const std::string& text) {
    std::string escaped;
    for (const char c : text) {
        if (c == '&') {
            escaped += "&amp;";
        } else if (c == '<') {
            escaped += "&lt;";
        } else {
            escaped += c;
        }
    }
    return escaped;
}

}  // namespace

std::string replayPage(const FlightRecording& recording) {
    const std::string data = scriptText(PageWriter(recording).data().dump());
    const std::string heading = htmlText(headingOf(recording.run));
    return filled(texts::replay_html, {{"style", texts::replay_css},
                                       {"heading", heading},
                                       {"data", data},
                                       {"three", texts::three_js},
                                       {"controls", texts::orbit_controls_js},
                                       {"script", texts::replay_js}});
}

}  // namespace hagen::avoidance
