#pragma once
#include <hagen/avoidance/OpenLoop.h>
#include <hagen/base/OutputPath.h>
#include <filesystem>
#include <fstream>
#include <memory>
#include <string>
#include <vector>
#include "base/OutputSet.h"

namespace hagen::avoidance {

/// The folder that `octomap-compare openloop` writes (docs/octomap-compare.md): openloop.csv,
/// scans.csv, agreement.csv and summary.json are reproducible, openloop_measured.csv and
/// scans_measured.csv are costs on this machine. The files appear only when complete.
class OpenLoopFiles {
 public:
    /// Throws std::runtime_error naming the path if a file exists and `overwrite` is false, if a
    /// file is one of the inputs, or if the folder cannot be created.
    OpenLoopFiles(const std::filesystem::path& folder, bool overwrite,
                  const std::vector<std::filesystem::path>& inputs = {});
    ~OpenLoopFiles();

    std::vector<std::filesystem::path> paths() const;

    void add(const OpenLoopRow& row, const OpenLoopCost& cost);
    /// Completes the files and removes partial files of earlier runs. Throws std::runtime_error
    /// naming the files that could not be written; the others are complete.
    void commit(const OpenLoop& open_loop, const OpenLoopResult& result);
    /// Keeps the results of a log that ended early as scans.partial.csv etc. Returns errors of
    /// files that could not be written, or "".
    std::string keepPartial(const OpenLoop& open_loop, const OpenLoopResult& result);

 private:
    struct File {
        File(const std::filesystem::path& file, bool overwrite)
            : path(file, base::kFile, overwrite) {}
        base::OutputPath path;
        std::ofstream out;
    };
    void finish(const OpenLoop& open_loop, const OpenLoopResult& result);

    std::filesystem::path folder_;
    bool is_own_folder_;
    std::vector<std::unique_ptr<File>> files_;
    base::OutputSet all_;
};

/// A description of the ground truth.
std::string truthOf(const OpenLoop& open_loop);

/// A text report: the log, one line per model, and the agreement of the models.
std::string tableOf(const OpenLoop& open_loop, const OpenLoopResult& result);

}  // namespace hagen::avoidance
