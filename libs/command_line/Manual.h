#pragma once
#include <string>

namespace CLI {
class App;
}

/// A program's flags as a manual page and as completions of shells. All are made from what --help
/// is made from.
namespace hagen::command_line {

/// Returns the manual page in roff, section 1. `date` as 2026-01-31.
std::string manualPage(const CLI::App& app, const std::string& program, const std::string& date);

/// Returns the completion script for bash.
std::string bashCompletion(const CLI::App& app, const std::string& program);

/// Returns the completion function for zsh.
std::string zshCompletion(const CLI::App& app, const std::string& program);

}  // namespace hagen::command_line
