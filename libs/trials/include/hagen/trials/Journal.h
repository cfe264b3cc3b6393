#pragma once
#include <hagen/trials/RunTable.h>
#include <hagen/trials/TrialMeasurement.h>
#include <filesystem>
#include <string>
#include <vector>

namespace hagen::trials {

/// Appends finished runs to a journal. Each line is on disk before the call returns.
class Journal {
 public:
    /// Throws std::runtime_error, naming the file.
    explicit Journal(std::filesystem::path file);
    ~Journal();
    Journal(const Journal&) = delete;
    Journal& operator=(const Journal&) = delete;
    /// Throws std::runtime_error, naming the file.
    void append(const Run& run, const TrialMeasurement& measurement);

 private:
    std::filesystem::path file_;
    int descriptor_;
};

/// One line of a journal: a row of runs.csv and one of measured.csv.
struct JournalLine {
    std::string run, measured;
};

/// The lines of a journal, which may still grow: a partial last line is left out. Throws
/// std::runtime_error, naming file and line, if any other is incomplete.
std::vector<JournalLine> readJournal(const std::filesystem::path& file);

/// The journals of a campaign's folder, by name; none once it is finished.
std::vector<std::filesystem::path> journalsIn(const std::filesystem::path& folder);

}  // namespace hagen::trials
