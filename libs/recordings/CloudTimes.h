#pragma once
#include <cstddef>
#include <string>
#include <vector>

namespace hagen::recordings {

/// The times of clouds, derived from the names of their files.
struct CloudTimes {
    std::vector<double> times_s;  ///< one per name
    std::string how;              ///< origin of the times, for the user
};

/// Names are file names without extension. Their numbers may follow letters, as in "cloud_12". If
/// all names have such times and these ascend, the numbers are times:
///
/// - "1317617735.25": seconds; "12.5" only if nothing precedes it, unlike "vlp16.000001".
/// - "1317617735_250000000", "1317617735_5": seconds and nanoseconds.
/// - "1317617735": seconds; 13 digits: milliseconds, 16: microseconds, 19: nanoseconds. Numbers
///   with a leading zero, such as "0000000042", are not times.
///
/// Otherwise clouds are 0.1 s apart: by number if the names are ascending whole numbers such as
/// "000042", else one after the other.
CloudTimes timesOfNames(const std::vector<std::string>& names);

/// The indices of names in the order of their scans: by the numbers at their ends if all have a
/// number after the same text ("cloud_9", "cloud_12"); otherwise alphabetical.
std::vector<std::size_t> orderOfNames(const std::vector<std::string>& names);

}  // namespace hagen::recordings
