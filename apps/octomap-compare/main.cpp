// Compares avoidance without a map with avoidance by one: flights, recordings, reports.
#include <CLI/CLI.hpp>
#include <cstdio>
#include <filesystem>
#include <iostream>
#include <string>
#include <vector>

#include "Commands.h"
#include "common/Interrupt.h"

namespace {

using namespace hagen;

constexpr int kFailed = 1, kWrongUsage = 2;

int fail(int exit_code, const std::string& message) {
    std::cerr << "octomap-compare: " << message << "\n";
    return exit_code;
}

/// What was printed has to have arrived.
int printed(int exit_code) {
    if (std::fflush(stdout) == 0 && std::cout.flush()) return exit_code;
    return fail(kFailed, "the results cannot be printed");
}

/// What to say where no command was understood.
std::string commandsOf(const CLI::App& app) {
    const std::vector<std::string> unknown = app.remaining();
    std::string text =
        unknown.empty() ? "no command is given" : "'" + unknown[0] + "' is no command";
    const char* before = "; there are ";
    const auto is_shown = [](const CLI::App* command) { return !command->get_group().empty(); };
    for (const CLI::App* command : app.get_subcommands(is_shown)) {
        text += before + command->get_name();
        before = ", ";
    }
    return text + " (octomap-compare --help tells more)";
}

}  // namespace

int main(int argc, char** argv) {
    CLI::App app{
        "Compares avoidance without a map (RoI points of the filter) with mapped avoidance."};
    app.footer(
        "Examples:\n"
        "  octomap-compare closedloop --scenario forest-0.05 --seeds 1000-1019 --models "
        "W-RoI,O-Full-0.4 -o runs\n"
        "  octomap-compare openloop -i flight.rawlog --poses flight.tum -o models\n"
        "  octomap-compare COMMAND --help\n"
        "Exit codes: 0 done, 1 failed while running, 2 wrong usage.");
    app.set_version_flag("--version", "octomap-compare " HAGEN_VERSION);
    app.require_subcommand(1);
    Command command;
    addClosedLoop(app, command);
    addMerge(app, command);
    addFlyRuns(app, command);
    addCalibrate(app, command);
    addOpenLoop(app, command);
    addReport(app, command);
    addReplay(app, command);
    try {
        app.parse(argc, argv);
        catchSignals();
        return printed(command());
    } catch (const CLI::Success& e) {  // --help, --version
        app.exit(e);
        return printed(0);
    } catch (const CLI::ParseError& e) {
        if (app.get_subcommands().empty()) return fail(kWrongUsage, commandsOf(app));
        app.exit(e);
        return kWrongUsage;
    } catch (const std::filesystem::filesystem_error& e) {
        return fail(kFailed, e.path1().string() + ": " + e.code().message());
    } catch (const std::exception& e) {
        return fail(kFailed, e.what());
    }
}
