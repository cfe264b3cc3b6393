#pragma once
#include <string_view>

/// The files of the viewer's page, embedded in the library.
namespace hagen::base::texts {

extern const std::string_view view_html, view_css, view_js, three_js, orbit_controls_js;

}  // namespace hagen::base::texts
