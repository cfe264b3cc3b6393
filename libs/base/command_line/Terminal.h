#pragma once
#include <ostream>
#include <string>

namespace hagen::base {

/// Makes std::cout and std::cerr print '?' instead of control characters (except tab and newline),
/// because sensor labels and file names from recordings could send commands to the terminal.
void keepTerminalSafe();

/// Replaces control characters, so that text from a recording cannot start a new line.
std::string oneLine(std::string message);

/// Erases the current line of a terminal: the only terminal command that keepTerminalSafe() passes.
std::ostream& clearLine(std::ostream& out);

}  // namespace hagen::base
