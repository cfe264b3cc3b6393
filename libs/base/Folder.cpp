#include "base/Folder.h"
#include <algorithm>

namespace hagen::base {

namespace fs = std::filesystem;

std::vector<fs::path> entriesOf(const fs::path& folder, std::error_code& error) {
    std::vector<fs::path> entries;
    for (fs::directory_iterator entry(folder, error), end; !error && entry != end;
         entry.increment(error)) {
        entries.push_back(entry->path());
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

}  // namespace hagen::base
