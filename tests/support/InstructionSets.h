#pragma once
#include <functional>
#include <string>

namespace hagen {

/// Runs `visit` once per instruction set supported by this machine and the libraries, from the
/// simplest to the widest, then restores the widest. Names are those of Highway: "SSE2", "AVX2".
void forEachInstructionSet(const std::function<void(const std::string& name)>& visit);

}  // namespace hagen
