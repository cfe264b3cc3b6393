#pragma once
#include <exception>
#include <string>

namespace hagen::observations {

/// Returns an exception's message in one line; for MRPT's, which contain back traces, only the
/// message; "" if it is not printable text.
std::string messageOf(const std::exception& exception);

}  // namespace hagen::observations
