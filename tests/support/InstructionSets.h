#pragma once
#include <functional>
#include <string>

namespace hagen {

/// Runs `visit` once on every instruction set that this machine has and the libraries were built
/// for, from the plainest to the widest, then goes back to the widest. The name is as Highway has
/// it: "SSE2", "AVX2", "NEON".
void forEachInstructionSet(const std::function<void(const std::string& name)>& visit);

}  // namespace hagen
