#pragma once
#include <sys/types.h>

#include <cstdio>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace hagen::trials {

/// A child process. What it writes to stderr is kept.
class WorkerProcess {
 public:
    /// Starts a program without a shell. Throws std::runtime_error, naming it.
    WorkerProcess(const std::string& program, const std::vector<std::string>& arguments);
    /// Stops it and waits for its end.
    ~WorkerProcess();
    WorkerProcess(const WorkerProcess&) = delete;
    WorkerProcess& operator=(const WorkerProcess&) = delete;

    /// Whether it has ended; does not wait.
    bool hasEnded();
    /// Asks it to end, by SIGTERM.
    void stop() const;

    // Once it has ended:
    /// "was killed by signal 9 (Killed)", "ended with exit status 3". Empty if it did not fail:
    /// exit status 0, or a signal that told it to stop.
    std::string failure() const;
    bool wasKilled() const;
    /// All that it wrote to stderr, without line breaks at the end.
    std::string errors() const;

 private:
    struct CloseFile {
        void operator()(std::FILE* file) const { std::fclose(file); }
    };
    std::unique_ptr<std::FILE, CloseFile> errors_;
    pid_t pid_ = 0;
    std::optional<int> status_;  ///< once it has ended
};

}  // namespace hagen::trials
