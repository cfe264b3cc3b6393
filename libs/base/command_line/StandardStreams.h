#pragma once

namespace hagen::base {

/// Opens /dev/null in place of a standard input, output or error that is closed. Otherwise the next
/// file that the program opens gets its number, and messages are written into that file.
void reserveStandardStreams();

}  // namespace hagen::base
