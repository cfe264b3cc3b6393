// Compares mapping-free with mapped avoidance: flies, reports, replays.
#include <CLI/CLI.hpp>
#include <iostream>
#include <stdexcept>

#include "Commands.h"

int main(int argc, char** argv) {
    CLI::App app{"Compare avoidance by regions of interest alone with avoidance by maps."};
    app.set_version_flag("--version", "octomap-compare " HAGEN_VERSION);
    app.require_subcommand(1);
    hagen::addReport(app);
    try {
        app.parse(argc, argv);
        return 0;
    } catch (const CLI::Success& e) {
        return app.exit(e);
    } catch (const CLI::ParseError& e) {
        app.exit(e);
        return 2;
    } catch (const std::invalid_argument& e) {
        std::cerr << "octomap-compare: " << e.what() << "\n";
        return 2;
    } catch (const std::exception& e) {
        std::cerr << "octomap-compare: " << e.what() << "\n";
        return 1;
    }
}
