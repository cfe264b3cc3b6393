#include "convert/pictures/Gnuplot.h"
#include <fcntl.h>
#include <signal.h>
#include <spawn.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>
#include <cerrno>
#include <chrono>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <memory>
#include <stdexcept>
#include <thread>
#include <vector>
#include "base/ProcessCost.h"

namespace hagen::convert {
namespace {

namespace fs = std::filesystem;

struct CloseFile {
    void operator()(std::FILE* file) const { std::fclose(file); }
};
using File = std::unique_ptr<std::FILE, CloseFile>;

/// Opens an in-memory file that is deleted when closed. Unlike a pipe, a file cannot deadlock while
/// gnuplot reads and prints.
File scratchFile(const std::string& content) {
    const int memory = memfd_create("gnuplot", MFD_CLOEXEC);
    File file(memory >= 0 ? fdopen(memory, "w+") : nullptr);
    if (!file && memory >= 0) close(memory);
    if (!file || std::fwrite(content.data(), 1, content.size(), file.get()) != content.size() ||
        std::fflush(file.get()) != 0 || std::fseek(file.get(), 0, SEEK_SET) != 0) {
        throw std::runtime_error(std::string("no temporary file for gnuplot: ") +
                                 std::strerror(errno));
    }
    return file;
}

/// The environment without the user's gnuplot terminal.
std::vector<char*> withoutTerminal() {
    std::vector<char*> kept;
    for (char** word = environ; *word != nullptr; ++word) {
        if (std::strncmp(*word, "GNUTERM=", 8) != 0) kept.push_back(*word);
    }
    kept.push_back(nullptr);
    return kept;
}

// Limits for a picture, which takes about 1 s of CPU time and less than 1 MB.
constexpr rlim_t kMaxCpu_s = 20, kMaxFileBytes = 64 << 20;
constexpr double kIdleTimeout_s = 5;  ///< time without CPU usage before gnuplot is killed
constexpr double kMinLoad = 0.02;

double cpuTimeOf_s(pid_t process) {
    const auto used = base::cpuTimeOf(process).value_or(std::chrono::nanoseconds(0));
    return std::chrono::duration<double>(used).count();
}

/// Waits for gnuplot, and kills its process group if it hangs or fills the disk. A hang is detected
/// by low CPU usage, because a picture may take many seconds on a busy machine. Returns the exit
/// status; `complaint` is the reason if it was killed.
int waitFor(pid_t process, std::string& complaint) {
    const rlimit cpu{kMaxCpu_s, kMaxCpu_s + 1}, file{kMaxFileBytes, kMaxFileBytes};
    prlimit(process, RLIMIT_CPU, &cpu, nullptr);
    prlimit(process, RLIMIT_FSIZE, &file, nullptr);
    const auto start = std::chrono::steady_clock::now();
    int status = 0;
    while (true) {
        const pid_t ended = waitpid(process, &status, WNOHANG);
        // If SIGCHLD is ignored, the status is lost (ECHILD); the pictures are checked anyway.
        if (ended == process || (ended < 0 && errno != EINTR)) break;
        const std::chrono::duration<double> passed = std::chrono::steady_clock::now() - start;
        if (passed.count() > kIdleTimeout_s && cpuTimeOf_s(process) < kMinLoad * passed.count()) {
            complaint = "timeout";
            break;
        }
        std::this_thread::sleep_for(std::chrono::milliseconds(passed.count() < 0.1 ? 1 : 10));
    }
    kill(-process, SIGKILL);
    if (complaint.empty()) return status;
    while (waitpid(process, &status, 0) < 0 && errno == EINTR) {
    }
    return status;
}

/// Returns gnuplot's last line; the lines before it repeat the command and mark the position.
std::string lastWord(std::FILE* errors) {
    std::rewind(errors);
    std::string word;
    for (char line[512]; std::fgets(line, sizeof line, errors) != nullptr;) {
        const std::string text(line, std::strcspn(line, "\n"));
        if (text.find("warning") == std::string::npos &&
            text.find_first_not_of(" ^") < text.size()) {
            word = text;
        }
    }
    return word;
}

/// True if the file starts and ends with the right bytes, so that it is not truncated.
bool isWhole(const fs::path& picture) {
    const bool is_svg = picture.extension() == ".svg";
    const std::string start = is_svg ? "<?xml" : std::string("\x89PNG\r\n\x1a\n", 8);
    const std::string end = is_svg ? "</svg>" : std::string("\0\0\0\0IEND\xae\x42\x60\x82", 12);
    const std::size_t blanks = is_svg ? 4 : 0;  // trailing newlines
    std::ifstream file(picture, std::ios::binary);
    std::string first(start.size(), 0), last(end.size() + blanks, 0);
    file.read(first.data(), static_cast<std::streamsize>(first.size()));
    file.seekg(-static_cast<std::streamoff>(last.size()), std::ios::end);
    file.read(last.data(), static_cast<std::streamsize>(last.size()));
    return file && first == start && last.find(end) != std::string::npos;
}

}  // namespace

std::string gnuplotString(const std::string& text) {
    std::string quoted = "'";
    for (const char c : text) {
        const bool is_control = static_cast<unsigned char>(c) < 0x20 || c == 0x7f;
        quoted += is_control ? ' ' : c;
        if (c == '\'') quoted += c;  // a doubled quote is a literal quote
    }
    return quoted + "'";
}

void runGnuplot(const std::string& script, const fs::path& folder,
                const std::vector<std::string>& pictures) {
    if (!fs::is_directory(folder)) {
        throw std::runtime_error(folder.string() + ": no such folder");
    }
    for (const std::string& picture : pictures) {  // removes old pictures
        std::error_code error;
        fs::remove(folder / picture, error);
        if (error) {
            throw std::runtime_error((folder / picture).string() +
                                     " cannot be written: " + error.message());
        }
    }

    const File input = scratchFile(script), errors = scratchFile("");
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_addchdir_np(&actions, folder.c_str());
    posix_spawn_file_actions_adddup2(&actions, fileno(input.get()), STDIN_FILENO);
    posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
    posix_spawn_file_actions_adddup2(&actions, fileno(errors.get()), STDERR_FILENO);
    // In its own process group, so that Ctrl-C reaches only our program, which ends after the
    // picture.
    posix_spawnattr_t attributes;
    posix_spawnattr_init(&attributes);
    posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETPGROUP);
    posix_spawnattr_setpgroup(&attributes, 0);
    char program[] = "gnuplot", no_settings_of_the_users[] = "-d";
    char script_file[] = "/dev/stdin";  // by name, because gnuplot reads stdin byte by byte
    char* const arguments[] = {program, no_settings_of_the_users, script_file, nullptr};
    pid_t child = 0;
    std::vector<char*> environment = withoutTerminal();
    const int error =
        posix_spawnp(&child, program, &actions, &attributes, arguments, environment.data());
    posix_spawnattr_destroy(&attributes);
    posix_spawn_file_actions_destroy(&actions);
    if (error == ENOENT) {
        throw std::runtime_error(
            "pictures require gnuplot, which is not installed; on Debian: "
            "apt-get install gnuplot-nox");
    }
    if (error != 0) {
        throw std::runtime_error(std::string("gnuplot cannot be run: ") + std::strerror(error));
    }
    std::string complaint;
    const int status = waitFor(child, complaint);
    if (complaint.empty()) complaint = lastWord(errors.get());
    for (const std::string& picture : pictures) {
        if (isWhole(folder / picture)) continue;
        throw std::runtime_error((folder / picture).string() + " could not be written completely" +
                                 (complaint.empty() ? "" : ": gnuplot: " + complaint));
    }
    if (status != 0) throw std::runtime_error("gnuplot failed: " + complaint);
}

}  // namespace hagen::convert
