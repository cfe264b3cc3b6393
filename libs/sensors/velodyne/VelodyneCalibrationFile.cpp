#include "sensors/velodyne/VelodyneCalibrationFile.h"
#include <hagen/scan/Angle.h>
#include <hagen/sensors/VelodyneModel.h>
#include <tinyxml2.h>
#include "base/ReadFile.h"

#include <cmath>
#include <map>
#include <stdexcept>

namespace hagen::sensors {
namespace {

constexpr std::size_t kMaxBytes = 4 << 20;

using tinyxml2::XMLElement;

const XMLElement& childOf(const tinyxml2::XMLNode& parent, const char* name) {
    const XMLElement* const found = parent.FirstChildElement(name);
    if (found != nullptr) return *found;
    throw std::runtime_error(std::string(name) + " is missing in line " +
                             std::to_string(parent.GetLineNum()));
}

double numberOf(const XMLElement& element) {
    double number = 0;
    if (element.QueryDoubleText(&number) == tinyxml2::XML_SUCCESS && std::isfinite(number)) {
        return number;
    }
    throw std::runtime_error(std::string(element.Name()) + " in line " +
                             std::to_string(element.GetLineNum()) + " is not a number");
}

double correctionOf(const XMLElement& laser, const char* name, double max) {
    const double correction = numberOf(childOf(laser, name));
    if (std::abs(correction) <= max) return correction;
    throw std::runtime_error(std::string(name) + " is " + std::to_string(correction) +
                             ", outside +-" + std::to_string(static_cast<int>(max)));
}

VelodyneLaser laserOf(const XMLElement& laser) {
    constexpr double kMax_cm = 100 * kMaxCorrection_m;
    VelodyneLaser corrected;
    corrected.azimuth_deg = correctionOf(laser, "rotCorrection_", 180);
    corrected.elevation_deg = correctionOf(laser, "vertCorrection_", 90);
    corrected.elevation_sine = std::sin(radians(corrected.elevation_deg));
    corrected.elevation_cosine = std::cos(radians(corrected.elevation_deg));
    corrected.distance_m = 0.01 * correctionOf(laser, "distCorrection_", kMax_cm);
    corrected.vertical_offset_m = 0.01 * correctionOf(laser, "vertOffsetCorrection_", kMax_cm);
    corrected.horizontal_offset_m = 0.01 * correctionOf(laser, "horizOffsetCorrection_", kMax_cm);
    return corrected;
}

VelodyneCalibration calibrationOf(const std::string& xml) {
    tinyxml2::XMLDocument document;
    if (document.Parse(xml.data(), xml.size()) != tinyxml2::XML_SUCCESS) {
        throw std::runtime_error(document.ErrorStr());
    }
    const XMLElement& root = childOf(childOf(document, "boost_serialization"), "DB");
    std::map<int, VelodyneLaser> lasers;
    const XMLElement& items = childOf(root, "points_");
    for (auto* item = items.FirstChildElement("item"); item != nullptr;
         item = item->NextSiblingElement("item")) {
        const XMLElement& laser = childOf(*item, "px");
        const double id = numberOf(childOf(laser, "id_"));
        if (!(id >= 0 && id < 1000)) throw std::runtime_error("a laser has an invalid id_");
        if (!lasers.emplace(static_cast<int>(id), laserOf(laser)).second) {
            throw std::runtime_error("laser " + std::to_string(static_cast<int>(id)) +
                                     " occurs twice");
        }
    }
    int count = static_cast<int>(lasers.size());
    if (const XMLElement* const enabled = root.FirstChildElement("enabled_")) {
        count = 0;
        for (auto* item = enabled->FirstChildElement("item"); item != nullptr;
             item = item->NextSiblingElement("item")) {
            count += numberOf(*item) != 0;
        }
    }
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
        calibration.lasers.push_back(found->second);
        const auto [other, is_new] = laser_at.emplace(found->second.elevation_deg, id);
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
