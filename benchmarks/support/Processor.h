#pragma once
#include <string>

namespace hagen {

/// Name of this machine's processor according to Linux; "unknown" if not available.
std::string processor();

}  // namespace hagen
