#pragma once

namespace hagen {

/// Does what HAGEN_SIMD says (InstructionSets.h). Scan.cpp calls it when a program starts, for
/// every program that has a loop to choose for has that file; a linker leaves out others.
bool startWithInstructionSets();

}  // namespace hagen
