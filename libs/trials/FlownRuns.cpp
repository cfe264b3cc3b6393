#include <hagen/trials/FlownRuns.h>

#include <hagen/trials/CampaignFile.h>
#include <hagen/trials/Journal.h>
#include <hagen/trials/MeasuredTable.h>
#include <algorithm>
#include <map>
#include <set>
#include <stdexcept>
#include <utility>

namespace hagen::trials {
namespace {

namespace fs = std::filesystem;

void addJournal(const fs::path& journal, std::set<std::string>& keys, FlownRuns& flown) {
    int line = 0;
    for (const JournalLine& written : readJournal(journal)) {
        ++line;
        try {
            const Run run = runOf(written.run);
            if (!keys.insert(keyOf(run)).second) continue;
            flown.runs.push_back(run);
            addMeasured(fullMeasuredHeader(), fullMeasuredRowOf(written.measured), flown.measured);
        } catch (const std::runtime_error& e) {
            throw std::runtime_error(journal.string() + ":" + std::to_string(line) + ": " +
                                     e.what());
        }
    }
}

/// Each planned run once, even if several plans contain it.
std::map<std::string, Run> plannedRuns(const fs::path& folder) {
    std::map<std::string, Run> planned;
    for (const CampaignPlan& plan : readPlans(folder)) {
        try {
            for (const CourseFlights& flights : flightsOf(plan)) {
                for (const TrialSetup& setup : flights.setups) {
                    Run run{};
                    run.scenario = flights.scenario;
                    run.seed = flights.seed;
                    run.setup = setup;
                    planned.try_emplace(keyOf(run), run);
                }
            }
        } catch (const std::invalid_argument& e) {
            throw std::runtime_error((folder / "campaign.json").string() + ": " + e.what() +
                                     "; was it written by another version, or changed by hand?");
        }
    }
    return planned;
}

void compareWithPlan(const fs::path& folder, const std::set<std::string>& keys, FlownRuns& flown) {
    std::map<std::pair<Condition, Contender>, Shortfall> by_contender;
    for (const auto& [key, run] : plannedRuns(folder)) {
        const Condition condition = conditionOf(run);
        const Contender contender = contenderOf(run);
        Shortfall& one =
            by_contender.try_emplace({condition, contender}, Shortfall{condition, contender, 0, 0})
                .first->second;
        const bool is_there = keys.count(key) > 0;
        one.flown += is_there ? 1 : 0;
        ++one.planned;
        flown.missing += is_there ? 0 : 1;
        ++flown.planned;
    }
    for (const auto& [key, one] : by_contender) {
        if (one.flown < one.planned) flown.shortfalls.push_back(one);
    }
}

FlownRuns readWith(const std::vector<fs::path>& journals, const fs::path& folder) {
    FlownRuns flown;
    const bool has_table = fs::exists(folder / "runs.csv");
    if (!has_table && journals.empty() && !fs::exists(folder / "campaign.json")) {
        throw std::runtime_error(
            folder.string() +
            ": contains no campaign; expected a folder of octomap-compare closedloop");
    }
    if (has_table) flown.runs = readRuns(folder / "runs.csv");
    if (fs::exists(folder / "measured.csv")) flown.measured = readMeasured(folder / "measured.csv");
    std::set<std::string> keys;
    for (const Run& run : flown.runs) keys.insert(keyOf(run));
    for (const fs::path& journal : journals) addJournal(journal, keys, flown);
    sortRuns(flown.runs);
    if (fs::exists(folder / "campaign.json")) compareWithPlan(folder, keys, flown);
    return flown;
}

bool isOneGone(const std::vector<fs::path>& journals) {
    return std::any_of(journals.begin(), journals.end(),
                       [](const fs::path& journal) { return !fs::exists(journal); });
}

}  // namespace

FlownRuns readFlownRuns(const fs::path& folder) {
    // A campaign that ends meanwhile writes runs.csv and removes its journals. Then everything is
    // read again, because the table has the runs of the journals now.
    constexpr int kAttempts = 5;
    for (int attempt = 1;; ++attempt) {
        const std::vector<fs::path> journals = journalsIn(folder);
        try {
            return readWith(journals, folder);
        } catch (const std::runtime_error&) {
            if (attempt == kAttempts || !isOneGone(journals)) throw;
        }
    }
}

}  // namespace hagen::trials
