#include <hagen/trials/FlownRuns.h>

#include <hagen/trials/CampaignFile.h>
#include <hagen/trials/Journal.h>
#include <hagen/trials/MeasuredTable.h>
#include <algorithm>
#include <map>
#include <stdexcept>
#include <utility>

namespace hagen::trials {
namespace {

namespace fs = std::filesystem;

/// The rows of runs by their keys.
using Rows = std::map<std::string, std::string>;

void addJournal(const fs::path& journal, Rows& rows, FlownRuns& flown) {
    int line = 0;
    for (const JournalLine& written : readJournal(journal)) {
        ++line;
        try {
            const Run run = runOf(written.run);
            const auto [known, is_new] = rows.try_emplace(keyOf(run), rowOf(run));
            if (!is_new && known->second != rowOf(run)) {
                throw std::runtime_error("contradicts another result of the same run: " +
                                         known->second);
            }
            if (!is_new) continue;
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
        if (planned.size() > kMostFlights) {
            throw std::runtime_error(folder.string() + ": has plans of more than " +
                                     std::to_string(kMostFlights) +
                                     " flights together, which are not reported in one; fly or "
                                     "merge parts of them into folders of their own");
        }
    }
    return planned;
}

void compareWithPlan(const fs::path& folder, const Rows& rows, FlownRuns& flown) {
    std::map<std::pair<Condition, Contender>, Shortfall> by_contender;
    for (const auto& [key, run] : plannedRuns(folder)) {
        const Condition condition = conditionOf(run);
        const Contender contender = contenderOf(run);
        Shortfall& one =
            by_contender.try_emplace({condition, contender}, Shortfall{condition, contender, 0, 0})
                .first->second;
        const bool is_there = rows.count(key) > 0;
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
    Rows rows;
    for (std::size_t i = 0; i < flown.runs.size(); ++i) {
        if (rows.try_emplace(keyOf(flown.runs[i]), rowOf(flown.runs[i])).second) continue;
        throw std::runtime_error((folder / "runs.csv").string() + ":" + std::to_string(i + 2) +
                                 ": a run that an earlier line has; remove one of them");
    }
    for (const fs::path& journal : journals) addJournal(journal, rows, flown);
    sortRuns(flown.runs);
    if (fs::exists(folder / "campaign.json")) compareWithPlan(folder, rows, flown);
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
