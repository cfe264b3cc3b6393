#pragma once
#include <cstddef>
#include <string>
#include <vector>

namespace hagen::recordings {

/// The times of clouds, derived from the names of their files.
struct CloudTimes {
    std::vector<double> times_s;  ///< one per name
    std::string how;              ///< "from the names of the files", for the user
};

/// Names are file names without extension. Their number may follow letters, as in "cloud_12". It is
/// a time, of all files or of none, if the times ascend:
///
/// - "1317617735.25": seconds; "12.5" only if nothing precedes it, unlike "vlp16.000001".
/// - "1317617735_250000000", "1317617735_5": seconds and nanoseconds.
/// - "1317617735": seconds, 13 digits: milliseconds, 16: microseconds, 19: nanoseconds. With a
///   leading zero, as "0000000042", these are numbers.
///
/// Otherwise clouds are 0.1 s apart: by number if the names are whole numbers that ascend, such as
/// "000042", else one after the other.
CloudTimes timesOfNames(const std::vector<std::string>& names);

/// The indices of names in the order in which their scans were taken: by the numbers at their ends
/// if all have one and the text before it is the same ("cloud_9", "cloud_12"); otherwise by name,
/// as text.
std::vector<std::size_t> orderOfNames(const std::vector<std::string>& names);

}  // namespace hagen::recordings
