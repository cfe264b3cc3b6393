#pragma once
#include <hagen/command_line/CommandLine.h>

namespace hagen {

using namespace command_line;  // Program, Command, Flag, UsageError

// Each adds a subcommand with its flags.
void addClosedLoop(Program& program);
void addFlyRuns(Program& program);
void addMerge(Program& program);
void addCalibrate(Program& program);
void addOpenLoop(Program& program);
void addReport(Program& program);
void addReplay(Program& program);

}  // namespace hagen
