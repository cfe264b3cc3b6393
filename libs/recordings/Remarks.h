#pragma once
#include <mrpt/core/Clock.h>
#include "sensors/captures/Remarks.h"

#include <chrono>
#include <cstdint>

namespace hagen::recordings {

using sensors::addCount;
using sensors::counted;

inline mrpt::Clock::time_point timeOf(std::int64_t since_1970_ns) {
    return mrpt::Clock::fromDouble(0) + std::chrono::duration_cast<mrpt::Clock::duration>(
                                            std::chrono::nanoseconds(since_1970_ns));
}

}  // namespace hagen::recordings
