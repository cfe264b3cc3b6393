// The outcome of a selection as a file, docs/selection.json: written by select-settings, read by
// paper-results.
#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "Descent.h"

namespace hagen::selection {

/// A setting, its value at present, and the values that were tried.
struct TriedSetting {
    std::string key, present;
    std::vector<std::string> tried;
};

/// A descent in figures.
struct Fold {
    std::string left_out;             ///< a drive; empty: none
    std::vector<std::string> chosen;  ///< the value of each setting
    double start = 0, objective = 0;
    MissedByGroup missed_start{}, missed{}, limit{};
    int rounds = 0;
};

/// The descents from one start: the first with all drives, then one without each.
struct Search {
    std::string start;  ///< in words
    std::vector<Fold> folds;
};

/// The scores of a drive. Vectors have one element per search.
struct DriveScores {
    std::string data, drive;       ///< "real, 16 beams", "00"
    Counts present;                ///< with the presets, which were tuned on it
    std::vector<Counts> with_all;  ///< with settings chosen on all drives
    std::vector<Counts> left_out;  ///< with settings chosen without this drive
};

struct Record {
    std::string revision;
    std::vector<std::uint64_t> seeds;     ///< of the simulated flights
    std::vector<std::string> hard_sets;   ///< degradations
    std::size_t scans = 0, measured = 0;  ///< scans in memory, and choices they were scored with
    std::vector<TriedSetting> settings;
    std::vector<Search> searches;
    std::vector<DriveScores> scores;

    /// The kinds of data and the drives, each once; drives are sorted.
    std::vector<std::string> data() const;
    std::vector<std::string> drives() const;
    /// The scores of a drive; nullptr if there are none.
    const DriveScores* find(const std::string& data_name, const std::string& drive) const;
};

std::string jsonOf(const Record& record);
/// Throws std::runtime_error naming the file: it cannot be read, or is no such record.
Record readRecord(const std::filesystem::path& file);

}  // namespace hagen::selection
