#pragma once
#include <string_view>

/// The files of the report page, embedded into the program.
namespace hagen::reports::texts {

extern const std::string_view report_html, report_css, report_js, chart_js;

}  // namespace hagen::reports::texts
