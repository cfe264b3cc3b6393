#pragma once
#include <string>

namespace hagen {

/// What Linux calls this machine's processor; "unknown" where it does not say.
std::string processor();

}  // namespace hagen
