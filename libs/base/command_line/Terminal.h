#pragma once
#include <cstddef>
#include <ostream>
#include <string>
#include <vector>

namespace hagen::base {

/// Makes std::cout and std::cerr print '?' instead of control characters (except tab and newline),
/// because sensor labels and file names from recordings could send commands to the terminal.
void keepTerminalSafe();

/// Replaces control characters, so that text from a recording cannot start a new line.
std::string oneLine(std::string message);

/// Erases the current line of a terminal: the only terminal command that keepTerminalSafe() passes.
std::ostream& clearLine(std::ostream& out);

/// Width of the terminal of standard error; 80 if unknown.
std::size_t terminalColumns();

/// Joins the leading parts that fit into a line of this width by " | "; cuts a longer first part.
std::string lineOf(const std::vector<std::string>& parts, std::size_t columns);

}  // namespace hagen::base
