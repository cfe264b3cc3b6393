#include "base/view/ViewPage.h"
#include <zlib.h>
#include "base/view/ViewTexts.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <new>

namespace hagen::base {
namespace {

constexpr double kTurn_rad = 6.283185307179586;
// The units of view.js and docs/view.md. The bias makes the upper byte 0 in most cases.
constexpr double kAzimuths = 16384, kElevationUnit_rad = 0.0005, kRangeUnit_m = 0.04;
constexpr double kOffsets = 8, kOffsetBias = 128;

std::vector<std::uint8_t> deflated(const std::vector<std::uint8_t>& bytes, int level) {
    uLongf size = compressBound(bytes.size());
    std::vector<std::uint8_t> packed(size);
    if (compress2(packed.data(), &size, bytes.data(), bytes.size(), level) != Z_OK) {
        throw std::runtime_error("zlib cannot compress a view page");
    }
    packed.resize(size);
    return packed;
}

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

template <class Integer>
std::vector<Integer> inUnits(const std::vector<float>& values, double unit) {
    std::vector<Integer> whole(values.size());
    std::transform(values.begin(), values.end(), whole.begin(), [&](float value) {
        return roundedTo<Integer>(static_cast<double>(value) / unit);
    });
    return whole;
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
    for (std::size_t at = 0; (at = text.find(from, at)) != std::string::npos; at += to.size()) {
        text.replace(at, from.size(), to);
    }
    return text;
}

/// JSON for a script element. In a string, "</script>" would end the element, and "<!--<script>"
/// would hide its end. JSON contains '<' only in strings.
std::string scriptText(const std::string& json) { return replaced(json, "<", "\\u003c"); }

std::string htmlText(const std::string& text) {
    return replaced(replaced(text, "&", "&amp;"), "<", "&lt;");
}

}  // namespace

template <class Integer>
Integer roundedTo(double value) {
    using Limits = std::numeric_limits<Integer>;
    if (std::isnan(value)) return 0;
    return static_cast<Integer>(std::lround(
        std::clamp(value, static_cast<double>(Limits::min()), static_cast<double>(Limits::max()))));
}
template std::uint8_t roundedTo(double);
template std::int16_t roundedTo(double);
template std::uint16_t roundedTo(double);

Json ViewArrays::json(int level) const {
    return {{"arrays", directory_}, {"data", base64(deflated(bytes_, level))}};
}

void ViewReturns::add(float x_m, float y_m, float z_m, std::uint8_t new_label) {
    const float flat_m = std::hypot(x_m, y_m);
    azimuth_rad.push_back(std::atan2(y_m, x_m));
    elevation_rad.push_back(std::atan2(z_m, flat_m));
    range_m.push_back(std::hypot(flat_m, z_m));
    label.push_back(new_label);
}

void addReturns(const ViewReturns& returns, ViewArrays& arrays) {
    // Relative to the column, azimuths take half the space.
    std::vector<std::int16_t> offset;
    std::vector<std::uint16_t> azimuth;
    for (std::size_t i = 0; i < returns.size(); ++i) {
        const double turns = static_cast<double>(returns.azimuth_rad[i]) / kTurn_rad;
        if (returns.pixel.empty() || returns.pixel[i] < 0) {
            azimuth.push_back(static_cast<std::uint16_t>(std::lround(turns * kAzimuths)));
            continue;
        }
        // The column's centre: column 0 faces backwards, columns run clockwise.
        const int column = returns.pixel[i] / returns.rows;
        const double centre = 0.5 - (column + 0.5) / returns.columns;
        const double columns = std::remainder(turns - centre, 1.0) * returns.columns;
        offset.push_back(roundedTo<std::int16_t>(kOffsets * columns + kOffsetBias));
    }
    arrays.add("offset", offset);
    arrays.add("azimuth", azimuth, true);
    arrays.add("elevation", inUnits<std::int16_t>(returns.elevation_rad, kElevationUnit_rad), true);
    arrays.add("range", inUnits<std::uint16_t>(returns.range_m, kRangeUnit_m), true);
    arrays.add("label", returns.label);
    if (!returns.intensity.empty()) {
        arrays.add("intensity", inUnits<std::uint8_t>(returns.intensity, 1.0 / 15));
    }
    if (!returns.obstacle.empty()) {
        std::vector<std::uint16_t> obstacles;
        for (std::size_t i = 0; i < returns.size(); ++i) {
            if (returns.label[i] != 2) continue;
            obstacles.push_back(roundedTo<std::uint16_t>(returns.obstacle[i]));
        }
        arrays.add("obstacle", obstacles);
    }
    if (!returns.pixel.empty()) arrays.add("pixel", returns.pixel, true);
}

void writeViewPage(std::ostream& out, const Json& data, const std::vector<std::string>& frames,
                   std::string_view extra_script) {
    std::string_view page = texts::view_html;
    for (;;) {
        const std::size_t begin = page.find("{{");
        out << page.substr(0, begin);
        if (begin == std::string_view::npos) return;
        const std::size_t end = page.find("}}", begin);
        const std::string_view name = page.substr(begin + 2, end - begin - 2);
        page.remove_prefix(end + 2);
        if (name == "heading") {
            out << htmlText(data.at("heading").get<std::string>());
        } else if (name == "data") {
            std::string head = scriptText(dumpJson(data));
            head.pop_back();  // the closing brace
            out << head << ",\"frames\":[";
            for (std::size_t i = 0; i < frames.size(); ++i) {
                out << (i > 0 ? "," : "") << scriptText(frames[i]);
            }
            out << "]}";
        } else {
            out << (name == "style"      ? texts::view_css
                    : name == "three"    ? texts::three_js
                    : name == "controls" ? texts::orbit_controls_js
                    : name == "extra"    ? extra_script
                                         : texts::view_js);
        }
    }
}

}  // namespace hagen::base
