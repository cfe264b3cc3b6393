#pragma once
#include <ostream>
#include <string>

namespace hagen::base {

/// Makes std::cout and std::cerr print '?' for control characters other than tab and newline,
/// because sensor labels and file names from recordings could send commands to the terminal.
void keepTerminalSafe();

/// A message without control characters: text from a recording cannot start a new line.
std::string oneLine(std::string message);

/// Erases the current line of a terminal. keepTerminalSafe() passes only this command.
std::ostream& clearLine(std::ostream& out);

}  // namespace hagen::base
