#include "evaluation/Degradation.h"
#include <hagen/scan/Angle.h>
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include "base/NumberText.h"
#include "base/Text.h"
#include "filter/image/Posture.h"

namespace hagen::evaluation {
namespace {

using Random = Degradation::Random;
using Function = Degradation::Function;

constexpr const char* kKnown =
    "dead_beams=R[,R...], dropout=PERCENT, noise_m=S, rain=PERCENT, roll_deg=A[,attitude], "
    "pitch_deg=A[,attitude], upside_down, fov_deg=A, above_deg=E, below_deg=E, dual_return, "
    "rate_hz=R";
constexpr float kNearestDrop_m = 0.5f, kFarthestDrop_m = 12.0f;
constexpr float kNearestReturn_m = 0.05f;  // noise must not move returns behind the sensor
constexpr float kDualStep_m = 1.0f;
constexpr double kDualChance = 0.3;
constexpr float kSteps = 2.5f;        // maximum spacing of neighbours, in azimuth steps
constexpr float kSameRay = 0.25f;     // returns closer than this fraction of a step share a ray
constexpr double kRecordedHz = 10.0;  // rate of recordings, for rate_hz

std::array<std::vector<float>*, 7> floatsOf(Scan& s) {
    return {&s.x_m, &s.y_m, &s.z_m, &s.intensity, &s.range_m, &s.azimuth_rad, &s.time_s};
}

/// Applies a function to each array with one element per return.
template <class Work>
void forEachArray(GroundTruthScan& scan, Work work) {
    for (std::vector<float>* values : floatsOf(scan.input.scan)) work(*values);
    work(scan.input.scan.row);
    work(scan.truth);
    work(scan.kinds);
    work(scan.objects);
    work(scan.heights_m);
}

/// Keeps the returns whose index passes `isKept`.
template <class IsKept>
GroundTruthScan filtered(const GroundTruthScan& scan, IsKept isKept) {
    std::vector<bool> is_kept(scan.input.scan.size());
    for (std::size_t i = 0; i < is_kept.size(); ++i) is_kept[i] = isKept(i);
    return partOf(scan, is_kept);
}

/// Moves a return along its ray.
void setRange(Scan& scan, std::size_t i, float range_m) {
    const float scale = range_m / scan.range_m[i];
    scan.x_m[i] *= scale;
    scan.y_m[i] *= scale;
    scan.z_m[i] *= scale;
    scan.range_m[i] = range_m;
}

/// Keeps the returns that `isKept(scan, sensor, index, random)` selects.
using IsKept = std::function<bool(const Scan&, const SensorModel&, std::size_t, Random&)>;
Function keeping(const IsKept& isKept) {
    return [isKept](const GroundTruthScan& scan, const SensorModel& sensor, Random& random) {
        return filtered(scan,
                        [&](std::size_t i) { return isKept(scan.input.scan, sensor, i, random); });
    };
}

Function withoutRows(const std::vector<int>& rows) {
    return keeping([rows](const Scan& scan, const SensorModel&, std::size_t i, Random&) {
        return std::find(rows.begin(), rows.end(), scan.row[i]) == rows.end();
    });
}

Function withDropout(double probability) {
    return keeping([probability](const Scan&, const SensorModel&, std::size_t, Random& random) {
        return !random.chance(probability);
    });
}

Function withinFov(double angle_deg) {
    const auto half_rad = static_cast<float>(radians(0.5 * angle_deg));
    return keeping([half_rad](const Scan& scan, const SensorModel&, std::size_t i, Random&) {
        return std::abs(scan.azimuth_rad[i]) <= half_rad;
    });
}

/// `side` is 1 for beams above the elevation, -1 for beams below.
Function withBeams(double elevation_deg, float side) {
    const auto elevation_rad = static_cast<float>(radians(elevation_deg));
    return keeping([=](const Scan& scan, const SensorModel& sensor, std::size_t i, Random&) {
        return side * (sensor.elevations_rad[scan.row[i]] - elevation_rad) > 0;
    });
}

Function withNoise(double sd_m) {
    return [sd_m](const GroundTruthScan& scan, const SensorModel&, Random& random) {
        GroundTruthScan noisy = scan;
        Scan& returns = noisy.input.scan;
        for (std::size_t i = 0; i < returns.size(); ++i) {
            const auto error_m = static_cast<float>(sd_m * random.normal());
            if (std::isnan(returns.range_m[i])) continue;
            setRange(returns, i, std::max(kNearestReturn_m, returns.range_m[i] + error_m));
        }
        return noisy;
    };
}

Function withRain(double probability) {
    return [probability](const GroundTruthScan& scan, const SensorModel&, Random& random) {
        GroundTruthScan rainy = scan;
        Scan& returns = rainy.input.scan;
        for (std::size_t i = 0; i < returns.size(); ++i) {
            const bool is_drop = random.chance(probability);
            const auto place = static_cast<float>(random.uniform());
            const float range_m = std::min(returns.range_m[i], kFarthestDrop_m);
            if (!is_drop || !(range_m > kNearestDrop_m)) continue;
            setRange(returns, i, kNearestDrop_m + place * (range_m - kNearestDrop_m));
            rainy.truth[i] = Label::Unclassified;
            if (!rainy.objects.empty()) rainy.objects[i] = 0;
        }
        return rainy;
    };
}

/// Turns the sensor, but not its surroundings. `turn` rotates from the turned sensor's frame to the
/// original frame. Rows and azimuths keep their original values.
GroundTruthScan turned(const GroundTruthScan& scan, const Eigen::Matrix3f& turn) {
    GroundTruthScan result = scan;
    rotatePoints(turn.transpose(), scan.input.scan, result.input.scan);
    result.true_level_from_sensor = scan.levelFromSensor() * turn;
    return result;
}

/// Sines of the elevations half a beam step below the lowest beam and above the highest. Elevations
/// beyond straight down and up, where the sine would decrease again, are represented by -2 and 2.
std::pair<float, float> fieldOfView(const SensorModel& sensor) {
    const std::vector<float>& beams = sensor.elevations_rad;
    const std::size_t top = beams.size() - 1;
    constexpr auto kStraight_rad = static_cast<float>(M_PI / 2);
    const float lowest_rad = beams[0] - 0.5f * (beams[1] - beams[0]);
    const float highest_rad = beams[top] + 0.5f * (beams[top] - beams[top - 1]);
    return {lowest_rad > -kStraight_rad ? std::sin(lowest_rad) : -2,
            highest_rad < kStraight_rad ? std::sin(highest_rad) : 2};
}

Function withTilt(const Eigen::Vector3f& axis, double angle_deg, bool is_known) {
    const Eigen::Matrix3f tilt =
        Eigen::AngleAxisf(static_cast<float>(radians(angle_deg)), axis).toRotationMatrix();
    return [tilt, is_known](const GroundTruthScan& scan, const SensorModel& sensor, Random&) {
        GroundTruthScan tilted = turned(scan, tilt);
        tilted.input.map_from_sensor = is_known ? tilted.true_level_from_sensor : std::nullopt;
        const auto [lowest, highest] = fieldOfView(sensor);
        const Scan& returns = tilted.input.scan;
        tilted = filtered(tilted, [&, low = lowest, high = highest](std::size_t i) {
            const float sine = returns.z_m[i] / returns.range_m[i];
            return sine >= low && sine <= high;
        });
        locateBeams(sensor, tilted.input.scan);
        return tilted;
    };
}

/// Rolls by 180 degrees: negates y and z, and adapts azimuth and row order.
GroundTruthScan upsideDown(const GroundTruthScan& scan, const SensorModel& sensor, Random&) {
    const Eigen::Matrix3f roll = Eigen::Vector3f(1, -1, -1).asDiagonal();
    GroundTruthScan result = turned(scan, roll);
    result.input.map_from_sensor = result.true_level_from_sensor;
    Scan& returns = result.input.scan;
    for (float& azimuth_rad : returns.azimuth_rad) azimuth_rad = -azimuth_rad;
    for (std::uint8_t& row : returns.row) row = static_cast<std::uint8_t>(sensor.rows() - 1 - row);
    returns.beams = beamSpan(mirrored(sensor));
    return result;
}

/// The returns of each row that have a range, by azimuth.
std::vector<std::vector<std::size_t>> rowsByAzimuth(const Scan& scan, int rows) {
    std::vector<std::vector<std::size_t>> by_row(static_cast<std::size_t>(rows));
    for (std::size_t i = 0; i < scan.size(); ++i) {
        if (!std::isnan(scan.range_m[i])) by_row[scan.row[i]].push_back(i);
    }
    for (std::vector<std::size_t>& row : by_row) {
        std::stable_sort(row.begin(), row.end(), [&](std::size_t a, std::size_t b) {
            return scan.azimuth_rad[a] < scan.azimuth_rad[b];
        });
    }
    return by_row;
}

/// The median step between different azimuths of a row; 0 if there are no steps.
float azimuthStep(const Scan& scan, const std::vector<std::vector<std::size_t>>& rows) {
    constexpr float kEqual_rad = 1e-5f;
    std::vector<float> steps_rad;
    for (const std::vector<std::size_t>& row : rows) {
        for (std::size_t k = 1; k < row.size(); ++k) {
            const float step_rad = scan.azimuth_rad[row[k]] - scan.azimuth_rad[row[k - 1]];
            if (step_rad > kEqual_rad) steps_rad.push_back(step_rad);
        }
    }
    if (steps_rad.empty()) return 0;
    const auto middle = steps_rad.begin() + static_cast<std::ptrdiff_t>(steps_rad.size() / 2);
    std::nth_element(steps_rad.begin(), middle, steps_rad.end());
    return *middle;
}

GroundTruthScan dualReturn(const GroundTruthScan& scan, const SensorModel& sensor, Random& random) {
    const Scan& returns = scan.input.scan;
    const auto rows = rowsByAzimuth(returns, sensor.rows());
    const float max_rad = kSteps * azimuthStep(returns, rows);
    std::vector<std::pair<std::size_t, std::size_t>> seconds;  // ray, and neighbour behind it
    for (const std::vector<std::size_t>& row : rows) {
        for (std::size_t k = 0; row.size() > 1 && k < row.size(); ++k) {
            const std::size_t ray = row[k];
            std::size_t nearest = ray;  // nearest of the farther neighbours
            for (const std::size_t side : {row.size() - 1, std::size_t{1}}) {
                const std::size_t other = row[(k + side) % row.size()];
                const double between_rad =
                    std::abs(std::remainder(static_cast<double>(returns.azimuth_rad[other]) -
                                                static_cast<double>(returns.azimuth_rad[ray]),
                                            2 * kPi));
                const bool is_behind = returns.range_m[other] > returns.range_m[ray] + kDualStep_m;
                if (!is_behind || between_rad > static_cast<double>(max_rad)) continue;
                if (nearest == ray || returns.range_m[other] < returns.range_m[nearest])
                    nearest = other;
            }
            if (nearest != ray && random.chance(kDualChance)) seconds.emplace_back(ray, nearest);
        }
    }
    GroundTruthScan result = scan;
    for (const auto& [ray, behind] : seconds) {
        const auto append = [](auto& values, std::size_t i) {
            if (!values.empty()) values.push_back(values[i]);
        };
        for (std::vector<float>* values : floatsOf(result.input.scan)) append(*values, ray);
        append(result.input.scan.row, ray);
        append(result.truth, behind);
        append(result.kinds, behind);
        append(result.objects, behind);
        append(result.heights_m, behind);
        setRange(result.input.scan, result.input.scan.size() - 1, returns.range_m[behind]);
    }
    return result;
}

/// Keeps one ray per azimuth bin, with all its returns.
Function atRate(double rate_hz) {
    return [rate_hz](const GroundTruthScan& scan, const SensorModel& sensor, Random&) {
        const Scan& returns = scan.input.scan;
        const auto rows = rowsByAzimuth(returns, sensor.rows());
        const float step_rad = azimuthStep(returns, rows);
        const double bin_rad = static_cast<double>(step_rad) * rate_hz / kRecordedHz;
        std::vector<bool> is_kept(returns.size(), step_rad <= 0);
        for (const std::vector<std::size_t>& row : rows) {
            double last_bin = -1;
            float kept_rad = 0;
            for (const std::size_t i : row) {
                const float azimuth_rad = returns.azimuth_rad[i];
                const double bin =
                    std::floor((static_cast<double>(azimuth_rad) + kPi + 1e-6) / bin_rad);
                const bool is_new = bin > last_bin;
                if (is_new) {
                    last_bin = bin;
                    kept_rad = azimuth_rad;
                }
                is_kept[i] = is_new || azimuth_rad - kept_rad < kSameRay * step_rad;
            }
        }
        return partOf(scan, is_kept);
    };
}

[[noreturn]] void fail(const std::string& text, const std::string& problem) {
    throw std::invalid_argument("'" + text + "': " + problem);
}

/// Parses the value of "key=value" as a number within limits.
double numberOf(const std::string& text, const std::string& value, double min, double max) {
    const auto number = base::numberFrom<double>(value);
    if (number && *number >= min && *number <= max) return *number;
    fail(text, "'" + value + "' is not a number from " + base::shortestText(min) + " to " +
                   base::shortestText(max));
}

std::vector<int> rowsOf(const std::string& text, const std::string& values) {
    std::vector<int> rows;
    for (const std::string& value : base::split(values, ',')) {
        const auto row = base::numberFrom<std::uint8_t>(value);
        if (!row) fail(text, "expected rows (0 is the lowest beam), as in dead_beams=7,8");
        rows.push_back(*row);
    }
    return rows;
}

}  // namespace

GroundTruthScan partOf(const GroundTruthScan& scan, const std::vector<bool>& is_kept) {
    GroundTruthScan part = scan;
    forEachArray(part, [&](auto& values) {
        std::size_t kept = 0;
        for (std::size_t i = 0; i < values.size(); ++i) {
            if (is_kept[i]) values[kept++] = values[i];
        }
        values.resize(kept);
    });
    return part;
}

SensorModel mirrored(const SensorModel& sensor) { return sensorIn(Posture::UpsideDown, sensor); }

Degradation::Degradation(const std::string& text) : name_(text) {
    const std::size_t equals = std::min(text.find('='), text.size());
    const std::string key = text.substr(0, equals);
    std::string value = equals < text.size() ? text.substr(equals + 1) : "";
    const auto number = [&](double min, double max) { return numberOf(text, value, min, max); };
    if (equals == text.size()) {
        if (key == "upside_down") {
            function_ = upsideDown;
            mirrors_sensor_ = true;
        } else if (key == "dual_return") {
            function_ = dualReturn;
        }
    } else if (key == "dead_beams") {
        const std::vector<int> rows = rowsOf(text, value);
        highest_row_ = *std::max_element(rows.begin(), rows.end());
        function_ = withoutRows(rows);
    } else if (key == "dropout") {
        function_ = withDropout(number(0, 100) / 100);
    } else if (key == "noise_m") {
        function_ = withNoise(number(0, 10));
    } else if (key == "rain") {
        function_ = withRain(number(0, 100) / 100);
    } else if (key == "roll_deg" || key == "pitch_deg") {
        const std::string known = ",attitude";
        const bool is_known = base::endsWith(value, known);
        if (is_known) value.resize(value.size() - known.size());
        const bool is_roll = key == "roll_deg";
        function_ = withTilt(is_roll ? Eigen::Vector3f::UnitX() : Eigen::Vector3f::UnitY(),
                             number(-90, 90), is_known);
    } else if (key == "fov_deg") {
        function_ = withinFov(number(1, 360));
    } else if (key == "above_deg") {
        function_ = withBeams(number(-90, 90), 1);
    } else if (key == "below_deg") {
        function_ = withBeams(number(-90, 90), -1);
    } else if (key == "rate_hz") {
        function_ = atRate(number(2 * kRecordedHz, 100));
    }
    if (!function_) fail(text, std::string("unknown; known: ") + kKnown);
}

void Degradation::checkSensor(const SensorModel& sensor) const {
    if (highest_row_ < sensor.rows()) return;
    fail(name_, "the sensor has rows 0 to " + std::to_string(sensor.rows() - 1));
}

GroundTruthScan Degradation::apply(const GroundTruthScan& scan, const SensorModel& sensor,
                                   std::uint64_t seed) const {
    checkSensor(sensor);
    Random random(seed);
    return function_(scan, sensor, random);
}

std::vector<Degradation> standardDegradations(const SensorModel& sensor) {
    constexpr int kDeadBeams = 16;
    std::vector<Degradation> all;
    const auto dead = [&](const std::string& rows) { all.emplace_back("dead_beams=" + rows); };
    const int sets = std::min(kDeadBeams, sensor.rows());
    for (int k = 0; k < sets; ++k) dead(std::to_string(k * sensor.rows() / sets));
    const int middle = 7 * sensor.rows() / kDeadBeams;
    dead(std::to_string(middle) + "," + std::to_string(middle + 1));
    for (const char* text : {"dropout=20", "dropout=50", "noise_m=0.05", "rain=0.1", "rain=1",
                             "rain=3", "roll_deg=20", "pitch_deg=20", "upside_down", "fov_deg=180",
                             "above_deg=-4", "below_deg=0", "dual_return", "rate_hz=20"})
        all.emplace_back(text);
    return all;
}

}  // namespace hagen::evaluation
