#include "convert/pictures/Drawing.h"
#include <signal.h>
#include <spawn.h>
#include <sys/socket.h>
#include <sys/time.h>
#include <sys/wait.h>
#include <unistd.h>
#include <cerrno>
#include <cstring>
#include <memory>
#include <mutex>
#include <stdexcept>
#include "base/ProcessCost.h"

namespace hagen::convert {
namespace {

constexpr int kIdleTimeout_s = 10;  ///< without CPU usage; a busy machine may take long to draw

/// A Python process that runs draw.py. A socket instead of pipes: writing to it after the process
/// ended is an error, not a signal.
class DrawingProcess {
 public:
    DrawingProcess() {
        int ends[2];
        if (socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends) != 0) fail(errno);
        socket_ = ends[0];
        constexpr timeval kTimeout{kIdleTimeout_s, 0};
        setsockopt(socket_, SOL_SOCKET, SO_SNDTIMEO, &kTimeout, sizeof kTimeout);
        setsockopt(socket_, SOL_SOCKET, SO_RCVTIMEO, &kTimeout, sizeof kTimeout);
        posix_spawn_file_actions_t actions;
        posix_spawn_file_actions_init(&actions);
        posix_spawn_file_actions_adddup2(&actions, ends[1], STDIN_FILENO);
        posix_spawn_file_actions_adddup2(&actions, ends[1], STDOUT_FILENO);
        // In its own process group, so that Ctrl-C reaches only our program, which ends after the
        // picture.
        posix_spawnattr_t attributes;
        posix_spawnattr_init(&attributes);
        posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETPGROUP);
        std::string program = "python3", utf8 = "-Xutf8", flag = "-c", script(texts::draw_py);
        char* const arguments[] = {program.data(), utf8.data(), flag.data(), script.data(),
                                   nullptr};
        const int error =
            posix_spawnp(&process_, program.c_str(), &actions, &attributes, arguments, environ);
        posix_spawnattr_destroy(&attributes);
        posix_spawn_file_actions_destroy(&actions);
        close(ends[1]);
        if (error == 0) return;
        close(socket_);
        fail(error);
    }

    ~DrawingProcess() {
        close(socket_);
        kill(-process_, SIGKILL);
        while (waitpid(process_, nullptr, 0) < 0 && errno == EINTR) {
        }
    }

    DrawingProcess(const DrawingProcess&) = delete;
    DrawingProcess& operator=(const DrawingProcess&) = delete;

    /// Sends a job and returns the answer, one line.
    std::string draw(std::string_view job) {
        while (!job.empty()) {
            const ssize_t sent = send(socket_, job.data(), job.size(), MSG_NOSIGNAL);
            if (sent > 0) job.remove_prefix(static_cast<std::size_t>(sent));
            if (sent < 0 && errno == EPIPE) break;  // it ended; its last answer says why
            if (sent < 0) checkProgress();
        }
        std::string line;
        for (char c = 0;;) {
            const ssize_t got = recv(socket_, &c, 1, 0);
            if (got == 1 && c == '\n') return line;
            if (got == 1) line += c;
            if (got == 0 || (got < 0 && errno == ECONNRESET)) {
                throw std::runtime_error("python3 ended without drawing");
            }
            if (got < 0) checkProgress();
        }
    }

 private:
    /// After a timeout, throws if the process has used no CPU time.
    void checkProgress() {
        if (errno == EINTR) return;
        const auto used = base::cpuTimeOf(process_);
        if (!used || *used - used_ < std::chrono::milliseconds(100)) {
            throw std::runtime_error("python3 hangs: it drew nothing for " +
                                     std::to_string(kIdleTimeout_s) + " s");
        }
        used_ = *used;
    }

    [[noreturn]] static void fail(int error) {
        throw std::runtime_error(std::string("pictures require python3 with matplotlib: ") +
                                 std::strerror(error) +
                                 "; on Debian: apt-get install python3-matplotlib");
    }

    int socket_ = -1;
    pid_t process_ = 0;
    std::chrono::nanoseconds used_{0};  ///< CPU time at the last timeout
};

}  // namespace

void Drawing::draw() {
    static std::mutex mutex;
    static std::unique_ptr<DrawingProcess> process;
    const std::lock_guard lock(mutex);
    if (!process) process = std::make_unique<DrawingProcess>();
    std::string problem;
    try {
        problem = process->draw(base::dumpJson(parameters_) + "\n" + arrays_);
    } catch (const std::exception&) {
        process.reset();
        throw;
    }
    if (problem.empty()) return;
    process.reset();  // it may have ended after this answer
    throw std::runtime_error(problem);
}

}  // namespace hagen::convert
