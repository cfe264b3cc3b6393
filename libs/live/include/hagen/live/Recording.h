#pragma once
#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

namespace hagen::live {

/// A capture of all datagrams that come to a session.
struct RecordingOptions {
    std::filesystem::path file;  ///< .pcap; empty: nothing is recorded
    bool overwrite = false;      ///< replaces existing files
    std::size_t queue = 4096;    ///< datagrams that wait for the disk at most

    /// Where the poses of the vehicle go, if some are known: beside `file`, with the extension
    /// .tum. Empty without `file`.
    std::filesystem::path posesFile() const {
        return std::filesystem::path(file).replace_extension(file.empty() ? "" : ".tum");
    }
};

/// The result of a recording.
struct Recorded {
    std::size_t packets = 0, poses = 0;        ///< written
    std::size_t left_out = 0;                  ///< datagrams that the disk was too slow for
    std::vector<std::filesystem::path> files;  ///< complete ones
    /// Why it ended early, naming the file and what is left of it; empty: it did not.
    std::string failure;
};

}  // namespace hagen::live
