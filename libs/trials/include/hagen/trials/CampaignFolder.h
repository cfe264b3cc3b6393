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
    /// anew), or if another program is writing to it. What is overwritten stays until the first
    /// files that replace it are complete.
    CampaignFolder(std::filesystem::path folder, const LatencyProfile& profile, bool overwrite);

    const std::filesystem::path& path() const { return folder_; }
    std::filesystem::path profileFile() const { return folder_ / "profile.json"; }
    const std::string& settingsHash() const { return campaign_.settings_hash; }

    /// Whether a run was flown, by this command or an earlier one.
    bool has(const Run& run) const { return rows_.count(keyOf(run)) > 0; }
    std::size_t size() const { return rows_.size(); }
    /// All runs, sorted.
    std::vector<Run> runs() const;

    /// Notes in campaign.json what is about to be flown; begins anew if it overwrites.
    void note(const CampaignPlan& plan);

    /// A file for a new journal.
    std::filesystem::path newJournal();
    /// Takes in the journals' runs. A partial last line is left out: its run is flown again. Throws
    /// std::runtime_error, naming file and line, for any other line that cannot be read.
    void readJournals();
    /// Throws std::runtime_error if another folder has other settings, or another result for the
    /// same run.
    void checkJoins(const CampaignFolder& other) const;
    /// Takes in the runs and plans of another folder, for finish(). Throws like checkJoins().
    void add(const CampaignFolder& other);

    /// Writes runs.csv, measured.csv and what else is new, and removes the journals.
    void finish();

 private:
    struct Row {
        Run run;
        std::string text, measured;
    };
    void open(bool overwrite);
    void begin();
    /// Writes files with these texts, by name. None gets its name before all are complete, and
    /// campaign.json is the first: a command that is killed in between leaves a campaign that the
    /// next one completes.
    void write(const std::map<std::string, std::string>& texts);
    /// Removes temporary files of a command that was killed.
    void removeUnfinished() const;
    void removeJournals() const;
    /// Removes an older campaign, except for campaign.json, which is to be replaced.
    void removeOld() const;
    void readTables();
    void keep(const std::string& text, const std::string& measured, const std::string& from);
    void addPlan(const std::string& plan);

    std::filesystem::path folder_;
    std::shared_ptr<const void> lock_;
    LatencyProfile profile_;
    CampaignFile campaign_;
    std::map<std::string, Row> rows_;  ///< by their keys
    bool replaces_ = false;            ///< an older campaign is in the folder, and is to go
    bool has_new_plans_ = false;       ///< that campaign.json does not have yet
    int next_journal_ = 1;
};

}  // namespace hagen::trials
