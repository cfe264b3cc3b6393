#pragma once
#include <CLI/CLI.hpp>
#include <functional>

namespace hagen {

/// What a subcommand does once all flags are read; answers the program's exit code. Wrong usage
/// that shows only then: a CLI::ParseError.
using Command = std::function<int()>;

// Each adds a subcommand with its flags, and sets `command` where it is the one that was given.
void addClosedLoop(CLI::App& app, Command& command);
void addFlyRuns(CLI::App& app, Command& command);
void addMerge(CLI::App& app, Command& command);
void addCalibrate(CLI::App& app, Command& command);
void addOpenLoop(CLI::App& app, Command& command);
void addReport(CLI::App& app, Command& command);
void addReplay(CLI::App& app, Command& command);

}  // namespace hagen
