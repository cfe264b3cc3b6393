#pragma once
#include <map>
#include <string>
#include <string_view>

namespace hagen {

/// The files of web/, and the libraries that pages carry with them.
namespace web {
extern const std::string_view report_html, report_css, report_js;
extern const std::string_view replay_html, replay_css, replay_js;
extern const std::string_view chart_js, three_js, orbit_controls_js;
}  // namespace web

/// A page with each {{name}} replaced. Throws std::logic_error for a name without a value.
std::string filled(std::string_view page, const std::map<std::string, std::string_view>& values);

/// JSON as it may stand in a script element.
std::string scriptText(std::string json);

}  // namespace hagen
