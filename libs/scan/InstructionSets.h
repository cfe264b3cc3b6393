#pragma once
#include <string>
#include <vector>

namespace hagen {

/// The instruction sets among which the vectorised loops choose, as names for HAGEN_SIMD: those
/// that this machine has, best first, such as "avx3" (AVX-512), "avx2", "sse4", "scalar". The last
/// one is what every such machine has; plain C++ is "scalar" or "emu128", by the compiler, and
/// known by both names.
std::vector<std::string> instructionSets();

/// From now on, loops use this instruction set or a simpler one, in all threads. Results are the
/// same bits on all of them; run times are not. For reports of faults, and for sanitizers. Upper
/// and lower case are the same; empty: no limit. A set that is known but better than what this
/// machine has limits nothing. "plain" is more: the ground stages run as they are defined
/// (libs/filter/ground), all others with the simplest set. Throws std::invalid_argument, listing
/// the names, for an unknown one.
///
/// The environment variable HAGEN_SIMD does the same when a program starts. An unknown name there
/// limits nothing and is reported on standard error.
void limitInstructionSets(const std::string& best);

/// Whether the last limit was "plain".
bool usesPlainStages();

}  // namespace hagen
