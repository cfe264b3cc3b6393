#pragma once
#include "common/CommandLine.h"

namespace hagen {

// Each adds a subcommand with its flags.
void addClosedLoop(Program& program);
void addFlyRuns(Program& program);
void addMerge(Program& program);
void addCalibrate(Program& program);
void addOpenLoop(Program& program);
void addReport(Program& program);
void addReplay(Program& program);

}  // namespace hagen
