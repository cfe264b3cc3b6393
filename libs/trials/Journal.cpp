#include <fcntl.h>
#include <hagen/base/Folder.h>
#include <hagen/trials/Journal.h>
#include <hagen/trials/MeasuredTable.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <stdexcept>
#include <system_error>

#include "TextFile.h"

namespace hagen::trials {

namespace fs = std::filesystem;

Journal::Journal(fs::path file)
    : file_(std::move(file)),
      descriptor_(::open(file_.c_str(), O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0666)) {
    if (descriptor_ < 0) failWith(file_, "cannot be written");
}

Journal::~Journal() { ::close(descriptor_); }

void Journal::append(const Run& run, const TrialMeasurement& measurement) {
    const std::string line = rowOf(run) + "\t" + measuredRowOf(run, measurement) + ";\n";
    for (std::size_t done = 0; done < line.size();) {
        const ssize_t wrote = ::write(descriptor_, line.data() + done, line.size() - done);
        if (wrote < 0 && errno == EINTR) continue;
        if (wrote <= 0) failWith(file_, "cannot be written");
        done += static_cast<std::size_t>(wrote);
    }
    // Some devices cannot sync; then there is nothing to wait for.
    if (fsync(descriptor_) != 0 && errno != EINVAL && errno != EROFS) {
        failWith(file_, "cannot be written");
    }
}

std::vector<JournalLine> readJournal(const fs::path& file) {
    std::vector<JournalLine> whole;
    const std::vector<std::string> lines = linesOf(file);
    for (std::size_t line = 0; line < lines.size(); ++line) {
        const std::size_t tab = lines[line].find('\t');
        if (tab == std::string::npos || lines[line].back() != ';') {
            if (line + 1 == lines.size()) break;  // torn: this run is flown again
            throw std::runtime_error(placeOf(file, line) + ": is not a line of a journal");
        }
        whole.push_back({lines[line].substr(0, tab),
                         lines[line].substr(tab + 1, lines[line].size() - tab - 2)});
    }
    return whole;
}

std::vector<fs::path> journalsIn(const fs::path& folder) {
    const fs::path place = folder / "journal";
    std::error_code error;  // the campaign may end, and remove them, at any time
    std::vector<fs::path> journals = base::entriesOf(place, error);
    if (error && error != std::errc::no_such_file_or_directory) {
        throw std::runtime_error(place.string() + ": cannot be read: " + error.message());
    }
    return journals;
}

}  // namespace hagen::trials
