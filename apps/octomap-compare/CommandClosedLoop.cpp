// octomap-compare closedloop: flies a simulated campaign.
#include <hagen/avoidance/Course.h>
#include <hagen/avoidance/Guidance.h>
#include <hagen/avoidance/Planner.h>
#include <hagen/avoidance/WorldModel.h>
#include <cstdio>
#include <iomanip>
#include <iostream>
#include <map>
#include <memory>
#include <thread>
#include "avoidance/flights/Campaign.h"
#include "base/NumberText.h"
#include "base/TextStream.h"

#include "Commands.h"
#include "base/Text.h"
#include "base/command_line/Interrupt.h"
#include "base/command_line/ProgressLine.h"

namespace hagen {
namespace {

struct Flags {
    avoidance::CampaignPlan plan;
    std::string seeds, shard = "1/1", unknown = "optimistic", profile, folder;
    std::vector<std::string> pose_errors{"none"}, airs{"dusty"}, distances{"unbiased"},
        updates{"scans"};
    int jobs = 0;
    bool overwrites = false, is_quiet = false;
};

template <class Value>
std::vector<Value> valuesOf(const std::vector<std::string>& names,
                            Value (*from)(const std::string&)) {
    std::vector<Value> values;
    for (const std::string& name : names) values.push_back(from(name));
    return values;
}

std::vector<avoidance::CourseFlights> flightsFrom(Flags& flags) {
    avoidance::CampaignPlan& plan = flags.plan;
    const auto one_seed = base::numberFrom<std::uint64_t>(flags.seeds);
    const auto seeds = one_seed ? std::optional(std::pair{*one_seed, *one_seed})
                                : base::numbersFrom<std::uint64_t>(flags.seeds, '-');
    if (!seeds) throw UsageError("--seeds", "'" + flags.seeds + "' is not a seed or a range A-B");
    std::tie(plan.first_seed, plan.last_seed) = *seeds;
    const auto shard = base::numbersFrom<int>(flags.shard, '/');
    if (!shard) throw UsageError("--shard", "'" + flags.shard + "' is not i/n (part i of n)");
    plan.brakes_in_known_space = flags.unknown == "brake-known";
    requireOnce("--speed", plan.speeds_m_s);
    requireOnce("--latency-scale", plan.latency_scales);
    requireOnce("--pose-error", flags.pose_errors);
    plan.pose_errors = valuesOf(flags.pose_errors, avoidance::poseErrorFrom);
    plan.airs = valuesOf(namesFrom("--air", flags.airs, {"dusty", "clear"}), avoidance::airFrom);
    plan.distances = valuesOf(namesFrom("--distance", flags.distances, {"unbiased", "as-stored"}),
                              avoidance::distanceFrom);
    plan.updates = valuesOf(namesFrom("--updates", flags.updates, {"scans", "sectors"}),
                            avoidance::updatesFrom);
    plan.scenarios = namesFrom("--scenario", plan.scenarios, avoidance::courseNames());
    plan.models = namesFrom("--models", plan.models, avoidance::worldModelNames());
    plan.guidances = namesFrom("--guidance", plan.guidances, avoidance::guidanceNames());
    plan.planners = namesFrom("--planner", plan.planners, avoidance::plannerNames());
    try {
        return avoidance::flightsOf(plan, {shard->first, shard->second});
    } catch (const std::invalid_argument& e) {
        throw UsageError("closedloop", e.what());
    }
}

avoidance::LatencyProfile profileFrom(const std::string& file,
                                      const std::vector<avoidance::CourseFlights>& flights) {
    const avoidance::LatencyProfile profile =
        file.empty() ? avoidance::standardLatencyProfile() : avoidance::readLatencyProfile(file);
    try {
        avoidance::checkProfile(profile, flights);
    } catch (const std::runtime_error& e) {
        throw std::runtime_error((file.empty() ? "the built-in profile" : file) + ": " + e.what());
    }
    return profile;
}

void printCells(const std::vector<avoidance::Run>& runs) {
    struct Cell {
        int runs = 0, outcomes[3] = {0, 0, 0};
    };
    std::map<std::string, Cell> cells;
    for (const avoidance::Run& run : runs) {
        base::TextStream name;
        const avoidance::TrialSetup& setup = run.setup;
        name << std::left << std::setw(12) << run.scenario << " " << std::setw(4) << setup.speed_m_s
             << " " << std::setw(9) << setup.guidance << " " << std::setw(11) << setup.planner
             << " " << std::setw(6) << nameOf(setup.pose_error) << " x" << std::setw(3)
             << setup.latency_scale << " " << std::setw(12)
             << (setup.brakes_in_known_space ? "brake-known" : "optimistic") << std::setw(6)
             << nameOf(setup.air) << std::setw(10) << nameOf(setup.distance) << std::setw(31)
             << avoidance::displayName(setup.model) + (setup.updates == avoidance::Updates::Scans
                                                           ? ""
                                                           : ", " + nameOf(setup.updates));
        Cell& cell = cells[name.str()];
        ++cell.runs;
        ++cell.outcomes[static_cast<int>(run.result.outcome)];
    }
    std::cout
        << "scenario     m/s  guidance  planner     pose   lat  unknown     air   distance  world "
           "model           "
           "           runs  success  collision  timeout\n";
    for (const auto& [name, cell] : cells) {
        std::cout << name << std::right << std::setw(6) << cell.runs << std::setw(9)
                  << cell.outcomes[0] << std::setw(11) << cell.outcomes[1] << std::setw(9)
                  << cell.outcomes[2] << "\n";
    }
}

int run(Flags flags) {
    const std::vector<avoidance::CourseFlights> flights = flightsFrom(flags);
    const avoidance::LatencyProfile profile = profileFrom(flags.profile, flights);
    ProgressLine progress("run");
    avoidance::CampaignOptions options;
    options.jobs =
        flags.jobs > 0 ? flags.jobs : static_cast<int>(std::thread::hardware_concurrency());
    options.overwrites = flags.overwrites;
    options.keep_going = [] { return !isInterrupted(); };
    if (!flags.is_quiet) {
        options.progress = [&](std::size_t done, std::size_t all) { progress.show(done, all); };
    }
    const std::vector<avoidance::Run> runs =
        avoidance::flyCampaign(flights, profile, flags.folder, options);
    if (flags.is_quiet) return 0;
    printCells(runs);
    std::cout << flags.folder << "/runs.csv\n";
    return 0;
}

void addFlags(Command& app, Flags& flags) {
    const auto list = [&](const char* flag, std::vector<std::string>& names,
                          const std::string& what) {
        return app.option(flag, names, what).delimiter(',').showDefault();
    };
    avoidance::CampaignPlan& plan = flags.plan;
    list("--scenario", plan.scenarios, "courses, or all: " + base::joined(avoidance::courseNames()))
        .required();
    app.option("--seeds", flags.seeds, "course seeds, A-B; the same seeds give the same runs")
        .required();
    app.option("--speed", plan.speeds_m_s, "maximum speeds in m/s (default: 4)").delimiter(',');
    takesWorldModels(list("--models", plan.models,
                          "world models, or all: " + base::joined(avoidance::worldModelNames())),
                     {"all"});
    list("--guidance", plan.guidances, "straight, astar or all");
    list("--planner", plan.planners, "primitives, 3dvfh or all");
    list("--pose-error", flags.pose_errors,
         "pose estimation error: none, noise (5 cm, 0.5 deg), drift (1 %)")
        .oneOf({"none", "noise", "drift"});
    app.option("--latency-scale", plan.latency_scales,
               "scale factors for the profile's latencies (default: 1); 4: an embedded computer")
        .delimiter(',');
    app.option("--unknown", flags.unknown,
               "unobserved space; optimistic: counts as free; brake-known: braking "
               "must end in observed space")
        .oneOf({"optimistic", "brake-known"})
        .showDefault();
    list("--air", flags.airs,
         "air: dusty (dust, mixed ranges at edges, the vehicle's masked legs), "
         "clear, or all")
        .oneOf({"dusty", "clear", "all"});
    list("--distance", flags.distances,
         "world model distances: unbiased (measured bias subtracted), as-stored, or all")
        .oneOf({"unbiased", "as-stored", "all"});
    list("--updates", flags.updates,
         "world model updates: scans (10 Hz), sectors (15 degrees, planner at 50 Hz), "
         "or all")
        .oneOf({"scans", "sectors", "all"});
    app.option("--profile", flags.profile,
               "latency profile from `calibrate` (default: built-in profile)");
    app.option("--shard", flags.shard, "fly part i of n, to distribute a campaign").showDefault();
    app.option("--jobs", flags.jobs, "parallel flights (default: one per core)").between(1, 1024);
    app.option("-o,--output", flags.folder,
               "campaign folder; the same command resumes an interrupted campaign, a different "
               "one adds to it")
        .required();
    app.flag("--overwrite", flags.overwrites, "start the folder from scratch");
    app.flag("-q,--quiet", flags.is_quiet, "print errors only");
}

}  // namespace

void addClosedLoop(Program& program) {
    const auto flags = std::make_shared<Flags>();
    Command sub =
        program.subcommand("closedloop", "fly courses in simulation to compare world models");
    addFlags(sub, *flags);
    sub.does([flags] { return run(*flags); });
}

}  // namespace hagen
