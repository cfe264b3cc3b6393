#pragma once
#include <exception>
#include <string>

namespace hagen::observations {

/// Returns an exception's message as one line, without the back traces of MRPT exceptions; "" if it
/// is not printable text.
std::string messageOf(const std::exception& exception);

}  // namespace hagen::observations
