#pragma once
#include <exception>
#include <string>

namespace hagen::observations {

/// What an exception says, in a line: of MRPT's, which carry back traces, the message alone; of one
/// that holds anything but text, "".
std::string messageOf(const std::exception& exception);

}  // namespace hagen::observations
