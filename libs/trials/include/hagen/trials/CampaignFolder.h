#pragma once
#include <hagen/trials/CampaignFile.h>
#include <hagen/trials/RunTable.h>
#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <vector>

namespace hagen::trials {

/// The folder of a campaign:
///
///     campaign.json  what holds for all runs, and the plans that were flown
///     profile.json   the latencies that runs draw from
///     journal/N.csv  finished runs, one per line, while the campaign goes on
///     runs.csv       all runs, sorted, at the end; the same bytes however they were flown
///     measured.csv   what they cost; differs each time
///
/// Later commands may add to a folder, even a finished one, as long as what holds for all runs
/// stays the same.
class CampaignFolder {
 public:
    /// Opens a folder or makes it, and locks it. Throws std::runtime_error, naming it, if it holds
    /// anything but a campaign, a campaign with other settings (unless `overwrite`, which begins
    /// anew), or if another program is writing to it.
    CampaignFolder(std::filesystem::path folder, const LatencyProfile& profile, bool overwrite);

    const std::filesystem::path& path() const { return folder_; }
    std::filesystem::path profileFile() const { return folder_ / "profile.json"; }
    const std::string& settingsHash() const { return campaign_.settings_hash; }

    /// Whether a run was flown, by this command or an earlier one.
    bool has(const Run& run) const { return rows_.count(keyOf(run)) > 0; }
    std::size_t size() const { return rows_.size(); }
    /// All runs, sorted.
    std::vector<Run> runs() const;

    /// Notes in campaign.json what is about to be flown.
    void note(const CampaignPlan& plan);

    /// A file for a new journal.
    std::filesystem::path newJournal();
    /// Takes in the journals' runs. A partial last line is left out: its run is flown again. Throws
    /// std::runtime_error, naming file and line, for any other line that cannot be read.
    void readJournals();
    /// Throws std::runtime_error if another folder has other settings, or another result for the
    /// same run.
    void checkJoins(const CampaignFolder& other) const;
    /// Takes in the runs of another folder. Throws like checkJoins().
    void add(const CampaignFolder& other);

    /// Writes runs.csv and measured.csv, and removes the journals.
    void finish();

 private:
    struct Row {
        Run run;
        std::string text, measured;
    };
    void open(bool overwrite);
    void begin();
    void writeProfile() const;
    /// Removes temporary files of a command that was killed.
    void removeUnfinished() const;
    void removeAll() const;
    void readTables();
    void keep(const std::string& text, const std::string& measured, const std::string& from);
    void addPlan(const std::string& plan);

    std::filesystem::path folder_;
    std::shared_ptr<const void> lock_;
    LatencyProfile profile_;
    CampaignFile campaign_;
    std::map<std::string, Row> rows_;  ///< by their keys
    int next_journal_ = 1;
};

}  // namespace hagen::trials
