#pragma once
#include <string>
#include <vector>

namespace hagen {

/// The instruction sets of this machine that the vectorised loops can use, as names for HAGEN_SIMD,
/// best first, such as "avx3" (AVX-512), "avx2", "sse4", "scalar". The last is the architecture's
/// baseline. Plain C++ is called "scalar" or "emu128", depending on the compiler; both names are
/// accepted.
std::vector<std::string> instructionSets();

/// Limits all threads' loops to this instruction set or a simpler one, for debugging and
/// sanitizers. Results are bit-identical on all sets; only run times differ. Case-insensitive; an
/// empty name removes the limit. A known set that this machine lacks has no effect. Throws
/// std::invalid_argument listing the names if the name is unknown.
///
/// The environment variable HAGEN_SIMD sets the limit at program start. An unknown name there only
/// prints a warning on standard error.
void limitInstructionSets(const std::string& best);

}  // namespace hagen
