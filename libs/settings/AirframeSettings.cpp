#include "settings/AirframeSettings.h"

#include "base/NumberText.h"
#include "base/TextStream.h"
#include "settings/AirframeFile.h"

#include "settings/YamlParts.h"

namespace hagen {
namespace {

namespace fs = std::filesystem;
constexpr double kMaxReach_m = 20;  // a larger mask would hide the avoidance zone

const std::string kForms =
    "{box: {low_m: [x, y, z], high_m: [x, y, z]}}, {sphere: {centre_m: [x, y, z], radius_m: r}} or "
    "{learned: FILE.yaml}";

/// Returns the values of a map with exactly these two keys.
std::pair<YAML::Node, YAML::Node> valuesOf(const YAML::Node& part, const std::string& name,
                                           const std::vector<std::string>& keys) {
    const std::string both = keys[0] + " and " + keys[1];
    if (!part.IsMap()) throw SettingsError(name + " must contain " + both);
    for (const auto& entry : part) {
        const std::string key = entry.first.IsScalar() ? entry.first.Scalar() : "?";
        if (key == keys[0] || key == keys[1]) continue;
        throw SettingsError(unknownKey(key, keys) + " (in '" + name + "')");
    }
    if (part.size() != 2 || !part[keys[0]] || !part[keys[1]]) {
        throw SettingsError(name + " must contain " + both + " once");
    }
    return {part[keys[0]], part[keys[1]]};
}

Eigen::Vector3f parsePoint(const YAML::Node& node, const std::string& key) {
    if (!node.IsSequence() || node.size() != 3) {
        throw SettingsError(key + " must be a list of three numbers: [x, y, z]");
    }
    Eigen::Vector3f point_m;
    for (int axis = 0; axis < 3; ++axis) {
        point_m[axis] = parseNumber<float>(node[axis], "each of " + key, -kMaxReach_m, kMaxReach_m);
    }
    return point_m;
}

AirframeBox parseBox(const YAML::Node& node) {
    const auto [low, high] = valuesOf(node, "airframe.box", {"low_m", "high_m"});
    const AirframeBox box{parsePoint(low, "airframe.box.low_m"),
                          parsePoint(high, "airframe.box.high_m")};
    if (!(box.low_m.array() < box.high_m.array()).all()) {
        throw SettingsError("each value of airframe.box.low_m must be below that of high_m");
    }
    return box;
}

AirframeSphere parseSphere(const YAML::Node& node) {
    const auto [centre, radius] = valuesOf(node, "airframe.sphere", {"centre_m", "radius_m"});
    const AirframeSphere sphere{
        parsePoint(centre, "airframe.sphere.centre_m"),
        parseNumber<float>(radius, "airframe.sphere.radius_m", 0, kMaxReach_m)};
    if (sphere.radius_m == 0) throw SettingsError("airframe.sphere.radius_m must be positive");
    return sphere;
}

void parsePart(const fs::path& file, const YAML::Node& part, SettingsOrigin origin,
               Settings::AirframeMask& mask) {
    if (!part.IsMap() || part.size() != 1) {
        throw SettingsError("each part of airframe must be one of " + kForms);
    }
    const std::string kind = part.begin()->first.Scalar();
    const YAML::Node value = part.begin()->second;
    if (kind == "box") {
        mask.parts.boxes.push_back(parseBox(value));
    } else if (kind == "sphere") {
        mask.parts.spheres.push_back(parseSphere(value));
    } else if (kind == "learned") {
        if (!mask.learned.empty()) {
            throw SettingsError("airframe.learned occurs twice; learn from one recording");
        }
        if (!value.IsScalar() || value.Scalar().empty()) {
            throw SettingsError("airframe.learned must be a file name");
        }
        if (origin == SettingsOrigin::Recording && fs::path(value.Scalar()).has_parent_path()) {
            throw SettingsError(
                "airframe.learned is '" + value.Scalar() +
                "'; settings stored with a recording may refer only to files in their own folder");
        }
        mask.learned = fs::absolute(file.parent_path() / value.Scalar()).lexically_normal();
        mask.parts.bin_range_m = readAirframeBins(mask.learned);
    } else {
        throw SettingsError(unknownKey(kind, {"box", "sphere", "learned"}) +
                            " (a part of airframe is one of " + kForms + ")");
    }
}

std::string textOf(const Eigen::Vector3f& point_m) {
    std::string text;
    for (const float value : point_m)
        text += (text.empty() ? "[" : ", ") + base::shortestText(value);
    return text + "]";
}

}  // namespace

Settings::AirframeMask parseAirframe(const fs::path& file, const YAML::Node& section,
                                     SettingsOrigin origin) {
    if (!section.IsSequence()) {
        throw SettingsError(at(file, section) + "airframe must be a list, each part one of " +
                            kForms);
    }
    Settings::AirframeMask mask;
    for (const YAML::Node& part : section) {
        try {
            parsePart(file, part, origin, mask);
        } catch (const std::exception& e) {
            throw SettingsError(at(file, part) + e.what());
        }
    }
    return mask;
}

std::string airframeText(const Settings::AirframeMask& mask) {
    if (mask.parts.isEmpty() && mask.learned.empty()) return "# airframe: no returns are masked\n";
    base::TextStream text;
    text << "airframe:  # parts of the vehicle in the sensor frame; their returns are "
            "unclassified\n";
    for (const AirframeBox& box : mask.parts.boxes) {
        text << "  - box: {low_m: " << textOf(box.low_m) << ", high_m: " << textOf(box.high_m)
             << "}\n";
    }
    for (const AirframeSphere& sphere : mask.parts.spheres) {
        text << "  - sphere: {centre_m: " << textOf(sphere.centre_m)
             << ", radius_m: " << base::shortestText(sphere.radius_m) << "}\n";
    }
    if (!mask.learned.empty()) {
        YAML::Emitter name;
        name << YAML::DoubleQuoted << mask.learned.string();
        text << "  - learned: " << name.c_str() << "\n";
    }
    return text.str();
}

}  // namespace hagen
