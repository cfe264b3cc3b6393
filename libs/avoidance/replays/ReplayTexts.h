#pragma once
#include <string_view>

/// The script that extends the viewer's page for replays, embedded in the program.
namespace hagen::avoidance::texts {

extern const std::string_view flight_js;

}  // namespace hagen::avoidance::texts
