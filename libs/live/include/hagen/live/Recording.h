#pragma once
#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

namespace hagen::live {

/// Options of a recording: a capture of all received datagrams.
struct RecordingOptions {
    std::filesystem::path file;  ///< .pcap; empty for no recording
    bool overwrite = false;      ///< replaces existing files
    std::size_t queue = 4096;    ///< maximum number of datagrams waiting for the disk

    /// File for the vehicle's poses, if known: `file` with the extension .tum. Empty without
    /// `file`.
    std::filesystem::path posesFile() const {
        return std::filesystem::path(file).replace_extension(file.empty() ? "" : ".tum");
    }
};

struct Recorded {
    std::size_t packets = 0, poses = 0;        ///< numbers written
    std::size_t left_out = 0;                  ///< datagrams dropped because the disk was too slow
    std::vector<std::filesystem::path> files;  ///< completed files
    /// Why recording stopped early, with the file and its partial copy; empty otherwise.
    std::string failure;
};

}  // namespace hagen::live
