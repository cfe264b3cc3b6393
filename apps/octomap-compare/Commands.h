#pragma once
#include <hagen/command_line/CommandLine.h>

namespace hagen {

using namespace command_line;  // Program, Command, Flag, UsageError

/// Lets a flag take world models by name or by displayed name, such as W-RoI and "RoI window".
/// Rejects any other text except those in `also`, and lists the names.
void takesWorldModels(Flag flag, const std::vector<std::string>& also = {});

// Each adds a subcommand with its flags.
void addClosedLoop(Program& program);
void addFlyRuns(Program& program);
void addMerge(Program& program);
void addCalibrate(Program& program);
void addDistances(Program& program);
void addOpenLoop(Program& program);
void addReport(Program& program);
void addReplay(Program& program);

}  // namespace hagen
