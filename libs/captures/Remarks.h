#pragma once
#include <hagen/captures/CaptureFile.h>

#include <cstddef>
#include <string>
#include <vector>

namespace hagen::captures {

/// "1 packet", "3 packets".
std::string counted(std::size_t number, const std::string& one);

/// Adds ", 3 packets MORE" unless there are none.
void addCount(std::size_t number, const std::string& one, const std::string& more,
              std::string& text);

/// The frames that did not become datagrams; "" if there are none.
std::string textOfLosses(const FrameCounts& counts);

}  // namespace hagen::captures
