#pragma once
#include <hagen/recordings/ScanSource.h>

#include <cstddef>
#include <filesystem>
#include <memory>
#include <mutex>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "PythonScan.h"

namespace hagen::python {

/// A recording that Python iterates, from one or several threads; each scan goes to one thread. All
/// functions require the GIL, and release it while reading.
class Recording {
 public:
    /// Throws FileNotFoundError, and exceptions of recordings::openRecording() and
    /// ScanSource::usePoses().
    Recording(const std::filesystem::path& file, recordings::SourceOptions options,
              const std::filesystem::path& poses);

    /// The next scan; nullopt at the end. Throws like ScanSource::nextScan(), and
    /// KeyboardInterrupt.
    std::optional<PythonScan> next();

    const std::filesystem::path& file() const { return file_; }
    std::string poseSource() const;
    std::vector<std::string> remarks() const;

 private:
    std::filesystem::path file_;
    std::vector<std::string> wanted_labels_;
    std::shared_ptr<recordings::ScanSource> source_;
    std::set<std::string> labels_;  ///< sensor labels of the scans read so far
    bool is_at_end_ = false;
    mutable std::mutex reading_;  ///< locked without the GIL, because sources sometimes acquire it
};

}  // namespace hagen::python
