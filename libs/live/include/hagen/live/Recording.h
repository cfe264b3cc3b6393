#pragma once
#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

namespace hagen::live {

/// What is recorded of a sensor, by a process of its own.
struct RecordingOptions {
    std::filesystem::path file;  ///< a rawlog; empty: nothing is recorded
    bool overwrite = false;
    /// A file ends with the turn that makes it this long; names are then NAME.0001.rawlog and so
    /// on. 0: one file.
    std::size_t rotate_bytes = 0;
    /// The settings of the recorded labels: files, of which later ones override earlier ones.
    std::vector<std::filesystem::path> settings_files;
    std::filesystem::path program;  ///< that records; empty: recorderProgram()
    /// A recorder that takes no packet of a live sensor for this long is ended, and so is one that
    /// shows no sign of life for this long at the end.
    double patience_s = 10;
};

/// What became of a recording.
struct Recorded {
    std::size_t turns = 0;                     ///< written
    std::size_t left_out = 0;                  ///< turns that the disk was too slow for
    std::size_t packets_left_out = 0;          ///< that came faster than the recorder took them
    std::size_t unreadable = 0;                ///< turns that were written without labels
    std::vector<std::filesystem::path> files;  ///< complete ones
    /// Of an earlier recording by this name, with higher numbers than these.
    std::vector<std::filesystem::path> older_files;
    /// Why it ended early, naming the file and what is left of it; empty: it did not.
    std::string failure;
};

/// The program of an installation that records, `live-record`: `../libexec/hagen` relative to the
/// running program, otherwise where this was installed.
std::filesystem::path recorderProgram();

}  // namespace hagen::live
