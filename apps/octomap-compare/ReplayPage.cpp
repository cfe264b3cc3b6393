#include <array>
#include <cmath>
#include <cstring>
#include <nlohmann/json.hpp>

#include "Replay.h"
#include "Summary.h"
#include "Table.h"
#include "Web.h"

namespace hagen {
namespace {

using Json = nlohmann::ordered_json;

/// A centimetre: coordinates of pages are whole numbers of it, 16 bits from the start on, so they
/// reach 327 m.
constexpr double kUnit_m = 0.01;

std::string base64(const std::vector<std::uint8_t>& bytes) {
    constexpr char kDigits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text;
    text.reserve((bytes.size() + 2) / 3 * 4);
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
        const std::size_t left = std::min<std::size_t>(3, bytes.size() - i);
        std::uint32_t group = 0;
        for (std::size_t k = 0; k < 3; ++k) group = (group << 8) | (k < left ? bytes[i + k] : 0u);
        for (std::size_t digit = 0; digit < 4; ++digit) {
            text += digit <= left ? kDigits[(group >> (18 - 6 * digit)) & 63u] : '=';
        }
    }
    return text;
}

/// Whole numbers of 16 bits, little-endian.
class Numbers {
 public:
    void add(double value) {
        const auto whole =
            static_cast<std::int16_t>(std::lround(std::fmax(-32768, std::fmin(32767, value))));
        bytes_.push_back(static_cast<std::uint8_t>(whole & 0xff));
        bytes_.push_back(static_cast<std::uint8_t>((whole >> 8) & 0xff));
    }
    std::string text() const { return base64(bytes_); }

 private:
    std::vector<std::uint8_t> bytes_;
};

class PageWriter {
 public:
    explicit PageWriter(const Recording& recording) : recording_(recording) {}

    Json data() const {
        Json data = head();
        data["track"] = points(recording_.track_m);
        Numbers lives;
        std::vector<Eigen::Vector3f> middles;
        for (const ModelCell& cell : recording_.model) {
            middles.push_back(cell.middle_m);
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
            {"model_name", run.setup.model},
            {"guidance", run.setup.guidance},
            {"speed_m_s", run.setup.speed_m_s},
            {"outcome", nameOf(run.result.outcome)},
            {"is_same", recording_.is_same},
            {"unit_m", kUnit_m},
            {"control_step_s", kControlStep_s},
            {"start_m", {recording_.start_m.x(), recording_.start_m.y(), recording_.start_m.z()}},
            {"ground_m", rounded(recording_.ground_m - recording_.start_m.z())},
            {"goal", points(std::vector<Eigen::Vector3d>{recording_.goal_m})},
            {"radius_m", run.setup.limits.radius_m}};
    }

    template <class Point>
    void add(const Point& at, Numbers& numbers) const {
        for (int axis = 0; axis < 3; ++axis) {
            const double from_start_m = static_cast<double>(at[axis]) - recording_.start_m[axis];
            numbers.add(from_start_m / kUnit_m);
        }
    }
    template <class Point>
    std::string points(const std::vector<Point>& all) const {
        Numbers numbers;
        for (const Point& at : all) add(at, numbers);
        return numbers.text();
    }

    Json json(const RecordedStep& step) const {
        Numbers ways;
        Json sizes = Json::array();
        for (const RecordedMotion& motion : step.motions) {
            for (const Eigen::Vector3f& at : motion.way_m) add(at, ways);
            const int points = static_cast<int>(motion.way_m.size());
            sizes.push_back(motion.is_free ? points : -points);  // negative: not free
        }
        const Eigen::Vector3d& v = step.velocity_m_s;
        return {{"time_s", step.time_s},
                {"clearance_m", rounded(step.clearance_m)},
                {"latency_ms", rounded(step.latency_ms)},
                {"speed_m_s", rounded(v.norm())},
                {"at", points(std::vector<Eigen::Vector3d>{step.position_m, step.carrot_m})},
                {"command_m_s",
                 {rounded(step.command_m_s.x()), rounded(step.command_m_s.y()),
                  rounded(step.command_m_s.z())}},
                {"emergency", step.is_emergency},
                {"roi", points(step.roi_m)},
                {"rou", points(step.rou_m)},
                {"path", points(step.path_m)},
                {"ways", ways.text()},
                {"way_sizes", sizes}};
    }

    static double rounded(double value) { return std::round(1000 * value) / 1000; }

    const Recording& recording_;
};

std::string headingOf(const Recording& recording) {
    const Run& run = recording.run;
    return run.scenario + ", seed " + std::to_string(run.seed) + ", " +
           nameOf(Contender{run.setup.model, run.setup.guidance}) + ", " +
           fixed(run.setup.speed_m_s, 1) + " m/s: " + nameOf(run.result.outcome);
}

}  // namespace

std::string replayPage(const Recording& recording) {
    const std::string data = scriptText(PageWriter(recording).data().dump());
    const std::string heading = htmlText(headingOf(recording));
    return filled(web::replay_html, {{"style", web::replay_css},
                                     {"heading", heading},
                                     {"data", data},
                                     {"three", web::three_js},
                                     {"controls", web::orbit_controls_js},
                                     {"script", web::replay_js}});
}

}  // namespace hagen
