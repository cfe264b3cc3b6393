#pragma once
#include <stdexcept>

namespace hagen::recordings {

/// A recording or one of its files is truncated, damaged or in an unknown format. The message names
/// the file and the place: an entry, a byte, a line or a row.
struct BrokenRecording : std::runtime_error {
    using std::runtime_error::runtime_error;
};

}  // namespace hagen::recordings
