#pragma once
#include <functional>
#include <string>

namespace hagen {

/// Runs `visit` once with every instruction set that this machine has and the libraries were built
/// for, from the simplest to the widest, then restores the widest. Names are Highway's: "SSE2",
/// "AVX2", "NEON".
void forEachInstructionSet(const std::function<void(const std::string& name)>& visit);

}  // namespace hagen
