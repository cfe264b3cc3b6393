#pragma once
#include <cstdint>

/// Streams of a course's seed that a flight draws from. Each has its own, so that what one part
/// draws, or leaves out, shifts nothing of another.
namespace hagen::trials::streams {

constexpr std::uint64_t kPose = 0x7001, kLatency = 0x7100 /* and one a stage */;
constexpr std::uint64_t kScan = 0x1000000 /* and one a turn */;
constexpr std::uint64_t kAltimeter = 0x2000000 /* and one a turn */;

}  // namespace hagen::trials::streams
