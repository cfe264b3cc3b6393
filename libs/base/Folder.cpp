#include <dirent.h>
#include <fcntl.h>
#include <ftw.h>
#include <unistd.h>

#include <hagen/base/Folder.h>
#include <algorithm>
#include <atomic>
#include <cerrno>
#include <cstdio>
#include <memory>
#include <string_view>

namespace hagen::base {

namespace fs = std::filesystem;

std::vector<fs::path> entriesOf(const fs::path& folder, std::error_code& error) {
    error.clear();
    std::vector<fs::path> entries;
    const auto fail = [&] { error.assign(errno, std::generic_category()); };
    const auto close = [](DIR* open) { closedir(open); };
    const std::unique_ptr<DIR, decltype(close)> open(opendir(folder.c_str()), close);
    if (open == nullptr) {
        fail();
        return entries;
    }
    while (true) {
        errno = 0;
        const dirent* const entry = readdir(open.get());
        if (entry == nullptr) break;
        const std::string_view name = entry->d_name;
        if (name != "." && name != "..") entries.push_back(folder / name);
    }
    if (errno != 0) fail();
    std::sort(entries.begin(), entries.end());
    return entries;
}

std::vector<fs::path> entriesOf(const fs::path& folder) {
    std::error_code error;
    std::vector<fs::path> entries = entriesOf(folder, error);
    if (error) throw fs::filesystem_error("cannot be listed", folder, error);
    return entries;
}

namespace {

/// Removes a tree with at most so many of its folders open; the errno of what could not be done.
int removeTree(const fs::path& path, int open_folders) noexcept {
    const auto removeOne = [](const char* one, const struct stat*, int, FTW*) {
        return std::remove(one);
    };
    errno = 0;
    if (nftw(path.c_str(), removeOne, open_folders, FTW_DEPTH | FTW_PHYS) == 0) return 0;
    return errno == ENOENT ? 0 : errno;
}

constexpr int kNone = -1;
std::atomic<int> spare_descriptor{kNone};

}  // namespace

void reserveForRemoval() noexcept {
    if (spare_descriptor != kNone) return;
    const int mine = open("/dev/null", O_RDONLY | O_CLOEXEC);
    int none = kNone;
    if (!spare_descriptor.compare_exchange_strong(none, mine) && mine >= 0) close(mine);
}

std::error_code removeAll(const fs::path& path) noexcept {
    constexpr int kOpenFolders = 16;
    int error = removeTree(path, kOpenFolders);
    if (error == EMFILE || error == ENFILE) {
        const int spare = spare_descriptor.exchange(kNone);
        if (spare >= 0) close(spare);
        error = removeTree(path, 1);
        reserveForRemoval();
    }
    return {error, std::generic_category()};
}

}  // namespace hagen::base
