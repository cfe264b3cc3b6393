#pragma once
#include <string_view>

/// The files of the replay page, embedded in the program.
namespace hagen::avoidance::texts {

extern const std::string_view replay_html, replay_css, replay_js, three_js, orbit_controls_js;

}  // namespace hagen::avoidance::texts
