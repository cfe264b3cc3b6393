#include "sensors/velodyne/VelodyneCalibrationFile.h"
#include <hagen/scan/Angle.h>
#include <hagen/sensors/VelodyneModel.h>
#include "base/ReadFile.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <fstream>
#include <iterator>
#include <map>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace hagen::sensors {
namespace {

constexpr std::size_t kMaxBytes = 4 << 20;
constexpr std::size_t kMaxDepth = 32;
constexpr std::size_t kMaxNameBytes = 64;  // limits the cost of building paths

std::string_view trimmed(std::string_view text) {
    constexpr std::string_view kBlanks = " \t\r\n";
    const std::size_t first = text.find_first_not_of(kBlanks);
    if (first == std::string_view::npos) return {};
    return text.substr(first, text.find_last_not_of(kBlanks) - first + 1);
}

/// Iterates over the elements of an XML text, ignoring attributes and entities.
class Elements {
 public:
    explicit Elements(std::string_view xml) : rest_(xml) {}

    /// Advances to the end of the next element. Returns false at the end of the text. `path`: such
    /// as "/DB/points_"; `text`: empty if the element has child elements.
    bool next(std::string& path, std::string_view& text) {
        while (true) {
            const std::size_t open = rest_.find('<');
            if (open == std::string_view::npos) {
                if (!names_.empty()) throw std::runtime_error("it ends within " + names_.back());
                return false;
            }
            text = trimmed(rest_.substr(0, open));
            rest_.remove_prefix(open);
            if (rest_.substr(0, 4) == "<!--") {
                take("-->");
                continue;
            }
            const std::string_view tag = take(">");
            if (tag[1] == '?' || tag[1] == '!') continue;
            if (tag[1] == '/') {
                const std::string name(trimmed(tag.substr(2, tag.size() - 3)));
                if (names_.empty() || names_.back() != name) {
                    throw std::runtime_error("</" + name.substr(0, 40) + "> has no opening tag");
                }
                path = pathOf();
                names_.pop_back();
                return true;
            }
            const std::string_view name = tag.substr(1, tag.find_first_of(" \t\r\n/>", 1) - 1);
            if (name.size() > kMaxNameBytes) {
                throw std::runtime_error("the element name '" + std::string(name.substr(0, 40)) +
                                         "...' has more than " + std::to_string(kMaxNameBytes) +
                                         " characters");
            }
            names_.emplace_back(name);
            if (names_.size() > kMaxDepth) throw std::runtime_error("it is nested too deeply");
            if (tag[tag.size() - 2] == '/') {
                path = pathOf();
                text = {};
                names_.pop_back();
                return true;
            }
        }
    }

 private:
    std::string_view take(std::string_view end) {
        const std::size_t at = rest_.find(end);
        if (at == std::string_view::npos) throw std::runtime_error("it ends within a tag");
        const std::string_view taken = rest_.substr(0, at + end.size());
        rest_.remove_prefix(taken.size());
        if (taken.size() < 3) throw std::runtime_error("it has an empty tag");
        return taken;
    }
    std::string pathOf() const {
        std::string path;
        for (const std::string& name : names_) path += "/" + name;
        return path;
    }

    std::string_view rest_;
    std::vector<std::string> names_;
};

double numberOf(std::string_view text, const std::string& what) {
    double number = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    if (error == std::errc() && end == text.data() + text.size() && std::isfinite(number)) {
        return number;
    }
    throw std::runtime_error(what + " is '" + std::string(text.substr(0, 40)) + "', not a number");
}

using Laser = std::map<std::string, double>;

double correctionOf(const Laser& laser, int id, const std::string& name, double max) {
    const auto found = laser.find(name);
    const std::string what = "laser " + std::to_string(id) + ": " + name;
    if (found == laser.end()) throw std::runtime_error(what + " is missing");
    if (std::abs(found->second) <= max) return found->second;
    throw std::runtime_error(what + " is " + std::to_string(found->second) + ", outside +-" +
                             std::to_string(static_cast<int>(max)));
}

VelodyneLaser laserOf(const Laser& laser, int id) {
    constexpr double kMax_cm = 100 * kMaxCorrection_m;
    VelodyneLaser corrected;
    corrected.azimuth_deg = correctionOf(laser, id, "rotCorrection_", 180);
    corrected.elevation_deg = correctionOf(laser, id, "vertCorrection_", 90);
    corrected.elevation_sine = std::sin(radians(corrected.elevation_deg));
    corrected.elevation_cosine = std::cos(radians(corrected.elevation_deg));
    corrected.distance_m = 0.01 * correctionOf(laser, id, "distCorrection_", kMax_cm);
    corrected.vertical_offset_m = 0.01 * correctionOf(laser, id, "vertOffsetCorrection_", kMax_cm);
    corrected.horizontal_offset_m =
        0.01 * correctionOf(laser, id, "horizOffsetCorrection_", kMax_cm);
    return corrected;
}

VelodyneCalibration calibrationOf(std::string_view xml) {
    const std::string kDb = "/boost_serialization/DB", kItem = kDb + "/points_/item";
    const std::string kLaser = kItem + "/px/";
    std::map<int, Laser> lasers;
    Laser laser;
    std::optional<int> enabled;
    Elements elements(xml);
    std::string path;
    std::string_view text;
    while (elements.next(path, text)) {
        if (path == kDb + "/enabled_/item") {
            enabled = enabled.value_or(0) + (numberOf(text, path) != 0 ? 1 : 0);
        } else if (path.rfind(kLaser, 0) == 0) {
            const std::string name = path.substr(kLaser.size());
            if (name.find('/') == std::string::npos && !text.empty()) {
                laser[name] = numberOf(text, path);
            }
        } else if (path == kItem) {
            const auto id = laser.find("id_");
            if (id == laser.end()) throw std::runtime_error("a laser has no id_");
            if (!(id->second >= 0 && id->second < 1000)) {
                throw std::runtime_error("a laser has the invalid id_ " +
                                         std::to_string(id->second));
            }
            if (!lasers.emplace(static_cast<int>(id->second), laser).second) {
                throw std::runtime_error("laser " + std::to_string(static_cast<int>(id->second)) +
                                         " occurs twice");
            }
            laser.clear();
        }
    }
    if (lasers.empty())
        throw std::runtime_error("it has no lasers (boost_serialization, DB, points_)");
    const int count = enabled.value_or(static_cast<int>(lasers.size()));
    if (count != hdl64Model().lasers) {
        throw std::runtime_error("it describes a sensor with " + std::to_string(count) +
                                 " lasers; an HDL-64E has 64");
    }
    VelodyneCalibration calibration;
    std::map<double, int> laser_at;
    for (int id = 0; id < count; ++id) {
        const auto found = lasers.find(id);
        if (found == lasers.end()) {
            throw std::runtime_error("laser " + std::to_string(id) + " is missing");
        }
        calibration.lasers.push_back(laserOf(found->second, id));
        const double elevation_deg = calibration.lasers.back().elevation_deg;
        const auto [other, is_new] = laser_at.emplace(elevation_deg, id);
        if (!is_new) {
            throw std::runtime_error("lasers " + std::to_string(other->second) + " and " +
                                     std::to_string(id) + " have the same elevation");
        }
    }
    return calibration;
}

}  // namespace

VelodyneCalibration readVelodyneCalibration(const std::filesystem::path& file) {
    const std::string xml = base::readText(file, kMaxBytes);
    try {
        return calibrationOf(xml);
    } catch (const std::runtime_error& e) {
        throw std::runtime_error(
            file.string() + ": is not an HDL-64E calibration (Velodyne's db.xml): " + e.what());
    }
}

}  // namespace hagen::sensors
