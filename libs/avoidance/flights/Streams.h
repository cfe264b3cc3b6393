#pragma once
#include <cstdint>

/// Random streams derived from a course's seed: one per purpose, so that an additional draw in one
/// does not shift the others.
namespace hagen::avoidance::streams {

constexpr std::uint64_t kPose = 0x7001, kLatency = 0x7100 /* plus the stage */;
constexpr std::uint64_t kScan = 0x1000000 /* plus the turn */;
constexpr std::uint64_t kAltimeter = 0x2000000 /* plus the turn */;
constexpr std::uint64_t kFirings = 0x100000000 /* plus 4096 per turn, and the first firing */;
constexpr std::uint64_t kAltimeterStep = 0x3000000 /* plus the control step */;

}  // namespace hagen::avoidance::streams
