#pragma once

namespace hagen::command_line {

/// Opens /dev/null in place of a standard input, output or error that is closed. Otherwise the next
/// file that the program opens gets its number, and messages are written into that file.
void reserveStandardStreams();

}  // namespace hagen::command_line
