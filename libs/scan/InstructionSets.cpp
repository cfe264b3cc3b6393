#include "scan/InstructionSets.h"
#include <hwy/highway.h>

#include <algorithm>
#include <cctype>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <stdexcept>

#include "scan/StartWithInstructionSets.h"

namespace hagen {
namespace {

std::string lowerCase(std::string text) {
    for (char& c : text) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    return text;
}

/// Instruction sets that the loops were compiled for, as bits. A better set has a lower bit.
std::vector<std::int64_t> compiledSets() {
    std::vector<std::int64_t> sets;
    for (std::int64_t rest = HWY_TARGETS; rest != 0; rest &= rest - 1) sets.push_back(rest & -rest);
    return sets;
}

std::string nameOf(std::int64_t set) { return lowerCase(hwy::TargetName(set)); }

/// True for plain C++, which Highway names differently depending on the compiler.
bool isScalar(const std::string& name) { return name == "scalar" || name == "emu128"; }

}  // namespace

std::vector<std::string> instructionSets() {
    std::vector<std::string> names;
    for (const std::int64_t set : hwy::SupportedAndGeneratedTargets()) names.push_back(nameOf(set));
    return names;
}

void limitInstructionSets(const std::string& best) {
    const std::string wanted = lowerCase(best);
    std::int64_t better = 0;
    if (!wanted.empty()) {
        const std::vector<std::int64_t> sets = compiledSets();
        const auto named = std::find_if(sets.begin(), sets.end(), [&](std::int64_t set) {
            return nameOf(set) == wanted || (isScalar(wanted) && isScalar(nameOf(set)));
        });
        if (named == sets.end()) {
            std::string names;
            for (const std::int64_t set : sets) names += (names.empty() ? "" : ", ") + nameOf(set);
            throw std::invalid_argument("'" + best + "' is not an instruction set of this build (" +
                                        names + ")");
        }
        better = *named - 1;
    }
    hwy::DisableTargets(better);
}

bool startWithInstructionSets() {
    const char* const name = std::getenv("HAGEN_SIMD");
    if (name == nullptr) return false;
    try {
        limitInstructionSets(name);
    } catch (const std::invalid_argument& e) {
        std::fprintf(stderr, "HAGEN_SIMD has no effect: %s\n", e.what());
    }
    return true;
}

}  // namespace hagen
