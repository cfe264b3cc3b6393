#include "WorkerProcess.h"

#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <stdexcept>

namespace hagen::trials {
namespace {

constexpr int kStatusLost = 255;  // no exit status of the programs

/// Starts a program whose stderr goes to a file. Returns 0 or an errno.
int spawn(const std::string& program, std::vector<std::string> arguments, std::FILE* errors,
          pid_t& pid) {
    std::vector<char*> words;
    for (std::string& argument : arguments) words.push_back(argument.data());
    words.push_back(nullptr);
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_adddup2(&actions, fileno(errors), STDERR_FILENO);
    // In a process group of its own: Ctrl-C in a terminal is for the program, which stops it.
    posix_spawnattr_t attributes;
    posix_spawnattr_init(&attributes);
    posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETPGROUP);
    posix_spawnattr_setpgroup(&attributes, 0);
    const int failed =
        posix_spawn(&pid, program.c_str(), &actions, &attributes, words.data(), environ);
    posix_spawnattr_destroy(&attributes);
    posix_spawn_file_actions_destroy(&actions);
    return failed;
}

}  // namespace

// A file, not a pipe: the worker may write as much as it likes, and nobody has to read meanwhile.
WorkerProcess::WorkerProcess(const std::string& program, const std::vector<std::string>& arguments)
    : errors_(std::tmpfile()) {
    if (!errors_) {
        throw std::runtime_error(std::string("no temporary file: ") + std::strerror(errno));
    }
    if (const int failed = spawn(program, arguments, errors_.get(), pid_)) {
        throw std::runtime_error(program + ": cannot be started: " + std::strerror(failed));
    }
}

WorkerProcess::~WorkerProcess() {
    if (status_) return;
    stop();
    while (waitpid(pid_, nullptr, 0) < 0 && errno == EINTR) {
    }
}

bool WorkerProcess::hasEnded() {
    if (status_) return true;
    int status = 0;
    const pid_t ended = waitpid(pid_, &status, WNOHANG);
    if (ended == pid_) status_ = status;
    // Somebody else took its status, such as a parent that ignores SIGCHLD.
    if (ended < 0 && errno == ECHILD) status_ = W_EXITCODE(kStatusLost, 0);
    return status_.has_value();
}

void WorkerProcess::stop() const {
    if (!status_) kill(pid_, SIGTERM);
}

std::string WorkerProcess::failure() const {
    if (wasKilled()) {
        const int signal = WTERMSIG(*status_);
        if (signal == SIGINT || signal == SIGTERM || signal == SIGHUP) return "";
        return "was killed by signal " + std::to_string(signal) + " (" + strsignal(signal) + ")";
    }
    const int status = WEXITSTATUS(*status_);
    return status == 0 ? "" : "ended with exit status " + std::to_string(status);
}

bool WorkerProcess::wasKilled() const { return WIFSIGNALED(*status_); }

std::string WorkerProcess::errors() const {
    std::rewind(errors_.get());
    std::string text;
    for (int c = 0; (c = std::fgetc(errors_.get())) != EOF;) text += static_cast<char>(c);
    while (!text.empty() && text.back() == '\n') text.pop_back();
    return text;
}

}  // namespace hagen::trials
