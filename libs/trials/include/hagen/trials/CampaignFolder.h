#pragma once
#include <hagen/trials/CampaignPlan.h>
#include <hagen/trials/RunTable.h>
#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <vector>

namespace hagen::trials {

/// What a run cost on the machine that it ran on; a row of measured.csv. Columns: those that name
/// the run (scenario,seed,model,guidance,speed,planner,pose_error,latency_scale,unknown), then
/// filter_p50_ms,filter_p95_ms, the same of update, guidance and planner (CPU time), and
/// peak_model_bytes (heap).
std::string measuredHeader();
std::string measuredRowOf(const Run& run, const TrialMeasurement& measurement);

/// What names a run: the columns of its settings and its seed.
std::string keyOf(const Run& run);

/// A folder that a campaign is flown into:
///
///     campaign.json  what holds for all runs, and what was flown
///     profile.json   the latencies drawn from
///     journal/N.csv  runs that are finished, a line each, while the campaign goes on
///     runs.csv       all runs, sorted, once it is done; the same bytes however it was flown
///     measured.csv   what they cost, which differs from time to time
///
/// Commands may add to a folder, also after its end, while what holds for all runs is the same.
class CampaignFolder {
 public:
    /// Opens a folder, or makes it. Throws std::runtime_error, naming it, where it holds anything
    /// but a campaign, one with other settings (unless `overwrite`: it begins anew then), or one
    /// that another program is writing to.
    CampaignFolder(std::filesystem::path folder, const LatencyProfile& profile, bool overwrite);

    const std::filesystem::path& path() const { return folder_; }
    const std::string& settingsHash() const { return settings_hash_; }

    /// Whether a run is there, from this command or one before.
    bool has(const Run& run) const { return rows_.count(keyOf(run)) > 0; }
    std::size_t size() const { return rows_.size(); }
    /// All runs, sorted.
    std::vector<Run> runs() const;

    /// Notes in campaign.json what is about to be flown.
    void note(const CampaignPlan& plan);

    /// A file for a journal that none has yet.
    std::filesystem::path newJournal();
    /// Takes in what the journals hold. A torn last line is left out: its run is flown again.
    /// Throws std::runtime_error, naming file and line, for any other that cannot be read.
    void readJournals();
    /// Takes in the runs of another folder. Throws std::runtime_error where it has other settings,
    /// or the same run with another result.
    void add(const CampaignFolder& other);

    /// Writes runs.csv and measured.csv, and removes the journals.
    void finish();

 private:
    struct Row {
        Run run;
        std::string text, measured;
    };
    void open(bool overwrite);
    void lock();
    void readTables();
    void keep(const std::string& run, const std::string& measured, const std::string& from);
    void writeDescription();

    std::filesystem::path folder_;
    std::shared_ptr<const int> lock_;  ///< the folder's descriptor, closed with the last copy
    LatencyProfile profile_;
    std::string settings_hash_;
    std::vector<std::string> flown_;   ///< plans, as JSON
    std::map<std::string, Row> rows_;  ///< by their keys
    int next_journal_ = 1;
};

/// Appends lines to a journal, each on disk before the call returns.
class Journal {
 public:
    /// Throws std::runtime_error, naming the file.
    explicit Journal(std::filesystem::path file);
    ~Journal();
    Journal(const Journal&) = delete;
    Journal& operator=(const Journal&) = delete;
    void append(const Run& run, const TrialMeasurement& measurement);

 private:
    std::filesystem::path file_;
    int descriptor_;
};

/// What a line of a journal holds: rows of runs.csv and measured.csv.
struct JournalLine {
    std::string run, measured;
};

/// The journals of a folder by name; none where it is finished.
std::vector<std::filesystem::path> journalsIn(const std::filesystem::path& folder);

/// The lines of a journal, which may be being written to: a torn last one is left out. Throws
/// std::runtime_error, naming file and line, for any other that is not whole.
std::vector<JournalLine> readJournal(const std::filesystem::path& file);

/// The plans that a folder's campaign.json notes. Throws std::runtime_error, naming it.
std::vector<CampaignPlan> readPlans(const std::filesystem::path& folder);

/// Joins the folders of shards into a new one, or one of the same settings: runs that several have
/// are taken once. Returns how many runs there are. Throws std::runtime_error for folders that
/// hold no finished or unfinished campaign, of other settings, or that contradict one another.
std::size_t mergeCampaigns(const std::vector<std::filesystem::path>& folders,
                           const std::filesystem::path& into, bool overwrite);

}  // namespace hagen::trials
