#pragma once
#include <string>
#include <vector>

namespace hagen {

/// The instruction sets of this machine that the vectorised loops can use, as names for HAGEN_SIMD,
/// best first, such as "avx3" (AVX-512), "avx2", "sse4", "scalar". The last one is the
/// architecture's baseline. Plain C++ is "scalar" or "emu128", depending on the compiler; both
/// names are accepted.
std::vector<std::string> instructionSets();

/// Restricts the loops of all threads to this instruction set or a simpler one, for debugging and
/// sanitizers. Results are bit-identical on all sets; only run times differ. Case-insensitive;
/// empty: no limit. A known set that is better than this machine's has no effect. "plain" also runs
/// the ground stages by their reference definition (libs/filter/ground), and all others with the
/// simplest set. Throws std::invalid_argument listing the names for an unknown name.
///
/// The environment variable HAGEN_SIMD does the same when a program starts. An unknown name there
/// has no effect except a warning on standard error.
void limitInstructionSets(const std::string& best);

/// True if the last limit was "plain".
bool usesPlainStages();

}  // namespace hagen
