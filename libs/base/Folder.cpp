// Uses POSIX calls because std::filesystem's iterators terminate the program if memory runs out.
#include <dirent.h>
#include <ftw.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <memory>
#include <string_view>
#include "base/Folder.h"

namespace hagen::base {

namespace fs = std::filesystem;

std::vector<fs::path> entriesOf(const fs::path& folder, std::error_code& error) {
    std::vector<fs::path> entries;
    const std::unique_ptr<DIR, int (*)(DIR*)> open(opendir(folder.c_str()), closedir);
    error.assign(open ? 0 : errno, std::generic_category());
    while (open) {
        errno = 0;
        const dirent* const entry = readdir(open.get());
        error.assign(errno, std::generic_category());
        if (entry == nullptr) break;
        const std::string_view name = entry->d_name;
        if (name != "." && name != "..") entries.push_back(folder / name);
    }
    std::sort(entries.begin(), entries.end());
    return entries;
}

std::vector<fs::path> entriesOf(const fs::path& folder) {
    std::error_code error;
    std::vector<fs::path> entries = entriesOf(folder, error);
    if (error) throw fs::filesystem_error("cannot be listed", folder, error);
    return entries;
}

std::error_code removeAll(const fs::path& path) noexcept {
    constexpr int kOpenFolders = 16;
    const auto removeOne = [](const char* one, const struct stat*, int, FTW*) {
        return std::remove(one);
    };
    errno = 0;
    const bool is_removed =
        nftw(path.c_str(), removeOne, kOpenFolders, FTW_DEPTH | FTW_PHYS) == 0 || errno == ENOENT;
    return {is_removed ? 0 : errno, std::generic_category()};
}

}  // namespace hagen::base
