#pragma once

namespace hagen {

/// Applies HAGEN_SIMD (InstructionSets.h). Called from Scan.cpp at program start, because every
/// program with vectorised loops links that file; a linker may drop others.
bool startWithInstructionSets();

}  // namespace hagen
