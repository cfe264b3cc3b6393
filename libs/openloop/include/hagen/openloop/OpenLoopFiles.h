#pragma once
#include <hagen/base/OutputPath.h>
#include <hagen/openloop/OpenLoop.h>
#include <filesystem>
#include <fstream>
#include <memory>
#include <string>
#include <vector>

namespace hagen::openloop {

/// The folder that `octomap-compare openloop` writes:
///
///     openloop.csv           a row a model
///     scans.csv              a row a scan and model
///     agreement.csv          a row a pair of models
///     summary.json           all of the first and third, and what was digested
///     openloop_measured.csv  a row a model: what this machine took
///     scans_measured.csv     a row a scan and model: what this machine took
///
/// All but the measured are the same, byte for byte, whenever the same log is digested. Files
/// appear when they are whole.
class OpenLoopFiles {
 public:
    /// Throws std::runtime_error, naming it, where a file exists and `overwrite` is not set, and
    /// where the folder cannot be made.
    OpenLoopFiles(const std::filesystem::path& folder, bool overwrite);
    ~OpenLoopFiles();

    /// Throws std::runtime_error, naming the file, where it cannot be written.
    void add(const OpenLoopRow& row, const OpenLoopCost& cost);
    /// Parts that earlier runs left are removed.
    void commit(const OpenLoop& open_loop, const OpenLoopResult& result);
    /// What was digested of a log that ended early: scans.partial.csv and so on.
    void keepPartial(const OpenLoop& open_loop, const OpenLoopResult& result);

 private:
    struct File {
        File(const std::filesystem::path& file, bool overwrite)
            : path(file, base::kFile, overwrite) {}
        base::OutputPath path;
        std::ofstream out;
    };
    File& open(const std::string& name, bool overwrite);
    void finish(const OpenLoop& open_loop, const OpenLoopResult& result);

    std::filesystem::path folder_;
    bool is_own_folder_;
    std::vector<std::unique_ptr<File>> files_;
    File *models_, *scans_, *agreement_, *summary_, *models_measured_, *scans_measured_;
};

/// How the truth of an open loop is called.
std::string truthOf(const OpenLoop& open_loop);

}  // namespace hagen::openloop
