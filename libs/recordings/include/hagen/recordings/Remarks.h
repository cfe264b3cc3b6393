#pragma once
#include <hagen/sensors/CaptureFile.h>
#include <mrpt/core/Clock.h>

#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <utility>

namespace hagen::recordings {

/// "1 packet", "3 packets".
std::string counted(std::size_t number, const std::string& one);

/// Adds ", 3 packets MORE" unless there are none.
void addCount(std::size_t number, const std::string& one, const std::string& more,
              std::string& text);

/// The datagrams of something else, by port and size.
class OtherDatagrams {
 public:
    void add(const sensors::Datagram& datagram);
    /// Adds ", 5 other UDP datagrams (most: 3 of 48 bytes to port 7503)" unless there are none.
    void describe(std::string& text) const;

 private:
    std::size_t all_ = 0;
    std::map<std::pair<std::uint16_t, std::size_t>, std::size_t> kinds_;
};

/// The frames that did not become datagrams; "" if there are none.
std::string textOfLosses(const sensors::FrameCounts& counts);

/// "350 frames; left out: LEFT_OUT and the losses".
std::string textOfFrames(const sensors::FrameCounts& counts, const std::string& left_out);

/// The time of a capture as MRPT's.
mrpt::Clock::time_point timeOf(std::int64_t since_1970_ns);

}  // namespace hagen::recordings
