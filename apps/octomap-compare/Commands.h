#pragma once
#include <CLI/CLI.hpp>

namespace hagen {

/// Each adds its subcommand, which runs when it was given. A CLI::ParseError or
/// std::invalid_argument is wrong usage, any other exception a failure.
void addReport(CLI::App& app);
void addReplay(CLI::App& app);

}  // namespace hagen
