#pragma once
#include <cstddef>
#include <string>
#include <vector>

namespace hagen::recordings {

struct CloudTimes {
    std::vector<double> times_s;  ///< one per name
    bool are_of_names = false;    ///< not assumed
    std::string how;              ///< how the times were derived, for messages
};

/// Derives times from file names without extension. Numbers may follow letters, as in "cloud_12".
/// The numbers are times if all names have one of these forms and the times ascend:
///
/// - "1317617735.25": seconds. "12.5" only if nothing precedes it, unlike in "vlp16.000001".
/// - "1317617735_250000000", "1317617735_5": seconds and nanoseconds.
/// - "1317617735": seconds; 13 digits: milliseconds, 16: microseconds, 19: nanoseconds. Numbers
///   with a leading zero, such as "0000000042", are not times.
///
/// Otherwise, clouds are 0.1 s apart. Ascending whole numbers such as "000042" are then frame
/// numbers, so that gaps are kept; other names are consecutive.
CloudTimes timesOfNames(const std::vector<std::string>& names);

/// The indices of names in scan order: by the numbers at their ends if all names have a number
/// after the same text ("cloud_9", "cloud_12"), otherwise alphabetical.
std::vector<std::size_t> orderOfNames(const std::vector<std::string>& names);

}  // namespace hagen::recordings
