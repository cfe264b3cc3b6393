#pragma once
#include <ostream>
#include <string>

namespace hagen::base {

/// Has std::cout and std::cerr print '?' for control characters other than tab and new line. Sensor
/// labels, file names and messages come from files, which could otherwise send commands to the
/// terminal.
void keepTerminalSafe();

/// A message without control characters: text of a recording, such as the label of a sensor, begins
/// no line of its own.
std::string oneLine(std::string message);

/// Erases the current line of a terminal. The only command that keepTerminalSafe() lets through.
std::ostream& clearLine(std::ostream& out);

}  // namespace hagen::base
