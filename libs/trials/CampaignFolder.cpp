#include <hagen/base/Folder.h>
#include <hagen/base/OutputPath.h>
#include <hagen/base/ReadFile.h>
#include <hagen/base/WriteFile.h>
#include <hagen/trials/CampaignFolder.h>
#include <hagen/trials/Journal.h>
#include <hagen/trials/Measured.h>
#include <hagen/trials/MeasuredTable.h>
#include <hagen/trials/SettingsHash.h>

#include <algorithm>
#include <charconv>
#include <stdexcept>
#include <string_view>
#include <utility>

#include "FolderLock.h"
#include "TextFile.h"

namespace hagen::trials {

namespace fs = std::filesystem;

namespace {

constexpr int kMostJournals = 1000000000;              // numbers beyond are no journals of ours
constexpr std::string_view kMarker = "campaign.json";  // tells the folder of a campaign
constexpr const char* kFiles[] = {"profile.json", "runs.csv", "measured.csv", "campaign.json"};

/// But for outputs that did not get their names, as of a run that failed while it made the folder.
bool holdsNothing(const fs::path& folder) {
    std::size_t partial = 0;
    for (const char* name : kFiles) partial += base::partialOutputs(folder / name).size();
    return base::entriesOf(folder).size() == partial;
}

/// What measured.csv would have of a run must be readable there.
void checkMeasured(const Run& run, const std::string& row) {
    if (row.empty()) return;
    MeasuredByContender ignored;
    addMeasured(fullMeasuredHeader(), fullMeasuredRowOf(row), ignored);
    if (keyOfMeasuredRow(row) != keyOf(run)) {
        throw std::runtime_error("what was measured is of another run");
    }
}

}  // namespace

CampaignFolder::CampaignFolder(fs::path folder, const LatencyProfile& profile, bool overwrite)
    : folder_(std::move(folder)), profile_(profile), campaign_{hashOfSettings(profile), {}} {
    open(overwrite);
}

void CampaignFolder::open(bool overwrite) {
    fs::create_directories(folder_);
    lock_ = lockFolder(folder_);  // first of all, because another program may be setting it up
    removeUnfinished();
    const bool is_new = holdsNothing(folder_);
    if (!is_new && !fs::exists(folder_ / kMarker)) {
        throw std::runtime_error(folder_.string() +
                                 ": exists and contains no campaign; choose another folder");
    }
    replaces_ = overwrite && !is_new;
    if (replaces_) return;  // only when what replaces it is written
    if (is_new) return begin();
    CampaignFile found = readCampaignFile(folder_);
    if (found.settings_hash != settingsHash()) {
        throw std::runtime_error(
            folder_.string() +
            ": contains runs with other settings (profile, version, filter, vehicle or ranges); "
            "choose "
            "another folder, give the profile of this one, or use --overwrite");
    }
    campaign_ = std::move(found);
    if (!fs::exists(profileFile())) begin();  // it was stopped in between
    readTables();
    readJournals();
}

void CampaignFolder::begin() {
    write({{"profile.json", textOf(profile_)}, {"campaign.json", textOf(campaign_, profile_)}});
}

void CampaignFolder::write(const std::map<std::string, std::string>& texts) {
    std::vector<std::unique_ptr<base::OutputPath>> outputs;
    for (const auto& [name, text] : texts) {
        const fs::path file = folder_ / name;
        outputs.push_back(std::make_unique<base::OutputPath>(file, base::kFile, true));
        base::writeText(text, outputs.back()->temporary(), file);
    }
    if (std::exchange(replaces_, false)) removeOld();
    for (const auto& output : outputs) output->commit();
}

void CampaignFolder::removeUnfinished() const {
    for (const char* name : kFiles) {
        for (const fs::path& left : base::partialOutputs(folder_ / name)) {
            if (left.filename().string().find(".tmp-") != std::string::npos) fs::remove(left);
        }
    }
}

void CampaignFolder::removeJournals() const {
    const std::error_code error = base::removeAll(folder_ / "journal");
    if (error) throw fs::filesystem_error("cannot be removed", folder_ / "journal", error);
}

void CampaignFolder::removeOld() const {
    removeJournals();
    for (const char* name : kFiles) {
        if (name != kMarker) fs::remove(folder_ / name);
    }
}

void CampaignFolder::addPlan(const std::string& plan) {
    std::vector<std::string>& plans = campaign_.plans;
    if (std::find(plans.begin(), plans.end(), plan) == plans.end()) plans.push_back(plan);
    std::sort(plans.begin(), plans.end());
}

void CampaignFolder::note(const CampaignPlan& plan) {
    const std::vector<std::string> before = campaign_.plans;
    addPlan(textOf(plan));
    if (replaces_ || campaign_.plans != before) begin();
}

void CampaignFolder::keep(const std::string& text, const std::string& measured,
                          const std::string& from) {
    const Run run = runOf(text);
    if (run.settings_hash != settingsHash()) throw std::runtime_error("a run with other settings");
    checkMeasured(run, measured);
    const auto [row, is_new] = rows_.try_emplace(keyOf(run), Row{run, text, measured});
    if (!is_new && row->second.text != text) {
        throw std::runtime_error("contradicts another result of the same run (" + from +
                                 "): " + row->second.text);
    }
}

void CampaignFolder::readTables() {
    const fs::path runs = folder_ / "runs.csv", costs = folder_ / "measured.csv";
    if (!fs::exists(runs)) return;
    std::map<std::string, std::string> measured;
    base::checkIsFile(costs);
    if (fs::exists(costs)) {
        readMeasured(costs);  // throws, naming the line
        for (const std::string& line : linesOf(costs)) measured[keyOfMeasuredRow(line)] = line;
    }
    for (const Run& run : readRuns(runs)) {
        keep(rowOf(run), measured[keyOf(run)], runs.string());
    }
}

void CampaignFolder::readJournals() {
    for (const fs::path& journal : journalsIn(folder_)) {
        const std::string name = journal.stem().string();
        int number = 0;
        std::from_chars(name.data(), name.data() + name.size(), number);
        if (number < kMostJournals) next_journal_ = std::max(next_journal_, number + 1);
        const std::vector<JournalLine> lines = readJournal(journal);
        for (std::size_t line = 0; line < lines.size(); ++line) {
            try {
                keep(lines[line].run, lines[line].measured, journal.string());
            } catch (const std::runtime_error& e) {
                throw std::runtime_error(placeOf(journal, line) + ": " + e.what());
            }
        }
    }
}

void CampaignFolder::checkJoins(const CampaignFolder& other) const {
    if (other.settingsHash() != settingsHash()) {
        throw std::runtime_error(other.folder_.string() + ": has other settings than " +
                                 folder_.string() + "; only parts of one campaign can be joined");
    }
    for (const auto& [key, row] : other.rows_) {
        const auto own = rows_.find(key);
        if (own == rows_.end() || own->second.text == row.text) continue;
        throw std::runtime_error(other.folder_.string() + ": " + row.text +
                                 " contradicts the result of the same run in " + folder_.string() +
                                 ": " + own->second.text);
    }
}

void CampaignFolder::add(const CampaignFolder& other) {
    checkJoins(other);
    for (const auto& [key, row] : other.rows_) rows_.try_emplace(key, row);
    for (const std::string& plan : other.campaign_.plans) addPlan(plan);
    has_new_plans_ = true;
}

fs::path CampaignFolder::newJournal() {
    if (replaces_) begin();
    fs::create_directories(folder_ / "journal");
    return folder_ / "journal" / (std::to_string(next_journal_++) + ".csv");
}

std::vector<Run> CampaignFolder::runs() const {
    std::vector<Run> all;
    for (const auto& [key, row] : rows_) all.push_back(row.run);
    sortRuns(all);
    return all;
}

void CampaignFolder::finish() {
    const std::vector<Run> all = runs();
    const bool is_full = std::any_of(all.begin(), all.end(), needsAllColumns);
    std::string table = (is_full ? fullRunHeader() : runHeader()) + "\n";
    std::string measured = (is_full ? fullMeasuredHeader() : measuredHeader()) + "\n";
    for (const Run& run : all) {
        const Row& row = rows_.at(keyOf(run));
        table += (is_full ? fullRowOf(run) : row.text) + "\n";
        if (row.measured.empty()) continue;
        measured += (is_full ? fullMeasuredRowOf(row.measured) : row.measured) + "\n";
    }
    std::map<std::string, std::string> texts{{"measured.csv", measured}, {"runs.csv", table}};
    if (replaces_ || has_new_plans_) {
        texts["profile.json"] = textOf(profile_);
        texts["campaign.json"] = textOf(campaign_, profile_);
    }
    write(texts);
    removeJournals();
}

}  // namespace hagen::trials
