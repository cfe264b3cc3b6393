#include "avoidance/flights/Campaign.h"
#include <hagen/avoidance/Trial.h>
#include <hagen/base/OutputPath.h>
#include "avoidance/flights/SettingsHash.h"
#include "base/Json.h"
#include "base/NumberText.h"
#include "base/ReadFile.h"
#include "base/WriteFile.h"

#include <algorithm>
#include <atomic>
#include <future>
#include <mutex>
#include <set>

namespace hagen::avoidance {
namespace {

namespace fs = std::filesystem;
using base::Json;

struct Stopped {};

void replace(const fs::path& file, const std::string& text) {
    base::OutputPath output(file, base::kFile, true);
    base::writeText(text, output.temporary(), file);
    output.commit();
}

/// A row without a line end is incomplete: its flight is repeated.
void removeIncompleteRow(const fs::path& table) {
    const std::string text = base::readText(table);
    const std::size_t complete = text.rfind('\n') + 1;  // 0 if there is no line end
    if (complete < text.size()) replace(table, text.substr(0, complete));
}

/// Prepares a folder for runs with these settings. Returns the finished runs in it.
std::vector<Run> openFolder(const fs::path& folder, const LatencyProfile& profile,
                            const std::string& settings, bool overwrites) {
    const fs::path campaign = folder / "campaign.json", table = folder / "runs.csv";
    const auto refuse = [](const fs::path& file) {
        throw std::runtime_error(file.string() +
                                 ": was flown with other settings (version or latency profile); "
                                 "choose another folder, or discard its runs with --overwrite");
    };
    fs::create_directories(folder);
    if (!fs::exists(campaign) && !fs::is_empty(folder)) {
        throw std::runtime_error(folder.string() +
                                 ": is not empty and has no campaign.json; choose an empty folder");
    }
    if (overwrites) {
        fs::remove(table);
    } else if (fs::exists(campaign)) {
        const nlohmann::json before = base::parseJson(base::readText(campaign));
        if (!before.contains("settings") || before["settings"] != settings) refuse(campaign);
    }
    const Json made{
        {"machine", profile.machine}, {"made_by", profile.made_by}, {"date", profile.date}};
    const Json root{{"settings", settings}, {"version", HAGEN_VERSION}, {"profile", made}};
    replace(campaign, root.dump(2) + "\n");
    replace(folder / "profile.json", textOf(profile));
    if (!fs::exists(table)) return {};
    removeIncompleteRow(table);
    std::vector<Run> runs = readRuns(table);
    for (const Run& run : runs) {
        if (run.settings_hash != settings) refuse(table);
    }
    return runs;
}

Run unflown(const CourseFlights& course, const TrialSetup& setup) {
    Run run{};
    run.scenario = course.scenario;
    run.seed = course.seed;
    run.setup = setup;
    return run;
}

/// The courses, each with the setups not yet flown.
std::vector<CourseFlights> missingFlights(const std::vector<CourseFlights>& flights,
                                          const std::vector<Run>& runs) {
    std::set<std::string> flown;
    for (const Run& run : runs) flown.insert(keyOf(run));
    std::vector<CourseFlights> missing;
    for (const CourseFlights& course : flights) {
        CourseFlights left{course.scenario, course.seed, {}};
        for (const TrialSetup& setup : course.setups) {
            if (flown.count(keyOf(unflown(course, setup))) == 0) left.setups.push_back(setup);
        }
        if (!left.setups.empty()) missing.push_back(std::move(left));
    }
    return missing;
}

void writeTable(const fs::path& file, std::vector<Run> runs) {
    sortRuns(runs);
    std::string text = runHeader() + "\n";
    for (const Run& run : runs) text += rowOf(run) + "\n";
    replace(file, text);
}

}  // namespace

std::vector<Run> flyCampaign(const std::vector<CourseFlights>& flights,
                             const LatencyProfile& profile, const fs::path& folder,
                             const CampaignOptions& options) {
    const std::string settings = hashOfSettings(profile);
    const std::vector<Run> before = openFolder(folder, profile, settings, options.overwrites);
    const fs::path file = folder / "runs.csv";
    writeTable(file, before);

    const std::vector<CourseFlights> courses = missingFlights(flights, before);
    std::size_t done = 0, all = 0;
    for (const CourseFlights& course : courses) all += course.setups.size();
    if (options.progress) options.progress(done, all);
    std::mutex mutex;  // guards the table and `done`
    std::atomic<std::size_t> next{0};
    std::atomic<bool> has_failed{false};
    TrialListener listener;
    listener.moved = [&](double, const VehicleState&) {
        if (has_failed || (options.keep_going && !options.keep_going())) throw Stopped();
    };
    const auto flyCourse = [&](const CourseFlights& flown) {
        const Course course = makeCourse(flown.scenario, flown.seed);
        for (const TrialSetup& setup : flown.setups) {
            Run run = unflown(flown, setup);
            run.oracle_path_m = course.oracle_path_m;
            run.settings_hash = settings;
            run.version = HAGEN_VERSION;
            run.result = runTrial(course, setup, profile, nullptr, listener);
            const std::lock_guard lock(mutex);
            std::ofstream out(file, std::ios::binary | std::ios::app);
            out << rowOf(run) + "\n";
            base::closeWritten(out, file);
            ++done;
            if (options.progress) options.progress(done, all);
        }
    };
    const auto flyCourses = [&] {
        try {
            for (std::size_t i = next++; i < courses.size(); i = next++) flyCourse(courses[i]);
        } catch (const Stopped&) {
        } catch (...) {
            has_failed = true;
            throw;
        }
    };
    std::vector<std::future<void>> jobs;
    for (int job = 0; job < options.jobs; ++job) {
        jobs.push_back(std::async(std::launch::async, flyCourses));
    }
    for (std::future<void>& job : jobs) job.get();
    if (done < all) {
        throw CampaignStopped("interrupted; " + std::to_string(done) + " of " +
                              base::counted(all, "run") + " kept in " + file.string() +
                              "; rerun the same command to resume");
    }
    std::vector<Run> runs = readRuns(file);
    writeTable(file, runs);
    sortRuns(runs);
    return runs;
}

}  // namespace hagen::avoidance
