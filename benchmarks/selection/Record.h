// The outcome of a selection as a file, docs/selection.json: written by select-settings, read by
// paper-results.
#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "Descent.h"

namespace hagen::selection {

/// A setting, its current value, and the candidate values.
struct TriedSetting {
    std::string key, present;
    std::vector<std::string> tried;
};

/// Summary of a descent.
struct Fold {
    std::string left_out;             ///< held-out drive, if any
    std::vector<std::string> chosen;  ///< the chosen value of each setting
    double start = 0, objective = 0;
    MissedByGroup missed_start{}, missed{}, limit{};
    int rounds = 0;
};

/// The descents from one start: first with all drives, then with each drive held out.
struct Search {
    std::string start;  ///< description
    std::vector<Fold> folds;
};

/// The scores of a drive. Vectors have one element per search.
struct DriveScores {
    std::string data, drive;       ///< "real, 16 beams", "00"
    Counts present;                ///< counts with the presets, which were tuned on this drive
    std::vector<Counts> with_all;  ///< counts with settings chosen on all drives
    std::vector<Counts> left_out;  ///< counts with settings chosen without this drive
};

struct Record {
    std::string revision;
    std::vector<std::uint64_t> seeds;     ///< seeds of the simulated flights
    std::vector<std::string> hard_sets;   ///< degradations
    std::size_t scans = 0, measured = 0;  ///< scans in memory, and scored choices
    std::vector<TriedSetting> settings;
    std::vector<Search> searches;
    std::vector<DriveScores> scores;

    /// The names of the data sets and of the drives, without duplicates; drives are sorted.
    std::vector<std::string> data() const;
    std::vector<std::string> drives() const;
    /// The scores of a drive; nullptr if missing.
    const DriveScores* find(const std::string& data_name, const std::string& drive) const;
};

std::string jsonOf(const Record& record);
/// Throws std::runtime_error naming a file that cannot be read or is not a valid record.
Record readRecord(const std::filesystem::path& file);

}  // namespace hagen::selection
