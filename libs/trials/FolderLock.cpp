#include "FolderLock.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <chrono>
#include <stdexcept>
#include <string>
#include <thread>

#include "TextFile.h"

namespace hagen::trials {
namespace {

/// An open file; child processes inherit it.
struct Descriptor {
    explicit Descriptor(const std::filesystem::path& folder)
        : number(::open(folder.c_str(), O_RDONLY | O_DIRECTORY)) {}
    ~Descriptor() {
        if (number >= 0) ::close(number);
    }
    Descriptor(const Descriptor&) = delete;
    Descriptor& operator=(const Descriptor&) = delete;
    int number;
};

}  // namespace

std::shared_ptr<const void> lockFolder(const std::filesystem::path& folder) {
    const auto descriptor = std::make_shared<const Descriptor>(folder);
    if (descriptor->number < 0) failWith(folder, "cannot be opened");
    // After a program is killed, its workers may take a moment to end.
    for (int attempt = 0; flock(descriptor->number, LOCK_EX | LOCK_NB) != 0; ++attempt) {
        if (attempt == 10) {
            throw std::runtime_error(folder.string() +
                                     ": another octomap-compare is writing to it");
        }
        std::this_thread::sleep_for(std::chrono::milliseconds(100));
    }
    return descriptor;
}

}  // namespace hagen::trials
