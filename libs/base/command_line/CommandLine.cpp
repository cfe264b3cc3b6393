#include "base/command_line/CommandLine.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <iostream>
#include <limits>
#include <new>
#include <sstream>
#include <type_traits>

#include "base/MemoryLimit.h"
#include "base/NumberText.h"
#include "base/command_line/Interrupt.h"
#include "base/command_line/Terminal.h"

namespace hagen::base {

namespace fs = std::filesystem;

namespace {

constexpr std::size_t kHelpWidth = 80, kHelpColumn = 30;
constexpr const char* kNotEmpty = "not empty";

/// Wraps a line of --help. Continuation lines are aligned with the descriptions.
std::string wrapped(std::string line) {
    std::string lines;
    line.erase(line.find_last_not_of(' ') + 1);
    while (line.size() > kHelpWidth) {
        const std::size_t end = line.rfind(' ', kHelpWidth);
        const bool has_word = line.find_first_not_of(' ') < end && end != std::string::npos;
        // Do not split a word that is longer than a line.
        const std::size_t cut = has_word ? end : line.find(' ', kHelpWidth);
        if (cut == std::string::npos) break;
        const std::size_t rest = line.find_first_not_of(' ', cut);
        if (rest == std::string::npos) break;
        const std::size_t indent = line[0] == ' ' ? kHelpColumn : 0;
        lines += line.substr(0, line.find_last_not_of(' ', cut) + 1) + "\n";
        line = std::string(indent, ' ') + line.substr(rest);
    }
    return lines + line;
}

/// CLI11's --help, wrapped to the width of a terminal.
class HelpText : public CLI::Formatter {
 public:
    HelpText() { column_width(kHelpColumn); }

    /// Without options that also have a flag.
    std::string make_positionals(const CLI::App* app) const override {
        const auto all = app->get_options([](const CLI::Option* option) {
            return option->get_positional() && !option->nonpositional();
        });
        return all.empty() ? "" : make_group(get_label("Positionals"), true, all);
    }
    /// The name of the value only; CLI11 would add types, limits and requirements.
    std::string make_option_opts(const CLI::Option* option) const override {
        const std::string& name = option->get_option_text();
        return name.empty() ? "" : " " + name;
    }
    std::string make_option_desc(const CLI::Option* option) const override {
        const std::string& standard = option->get_default_str();
        return option->get_description() + (option->get_required() ? " (required)" : "") +
               (standard.empty() ? "" : " (default: " + standard + ")");
    }
    /// With "Usage: ", which CLI11 2.6 omits.
    std::string make_usage(const CLI::App* app, std::string name) const override {
        const std::string usage = CLI::Formatter::make_usage(app, std::move(name));
        return usage[0] == 'U' ? usage : "Usage: " + usage.substr(1);
    }
    std::string make_help(const CLI::App* app, std::string name,
                          CLI::AppFormatMode mode) const override {
        std::istringstream lines(CLI::Formatter::make_help(app, std::move(name), mode));
        std::string text;
        for (std::string line; std::getline(lines, line);) text += wrapped(line) + "\n";
        return text;
    }
};

}  // namespace

Flag& Flag::required() {
    option_->required();
    return *this;
}
Flag& Flag::once() {
    option_->allow_extra_args(false);
    return *this;
}
Flag& Flag::delimiter(char mark) {
    option_->delimiter(mark);
    return *this;
}
Flag& Flag::needs(const Flag& other) {
    option_->needs(other.option_);
    return *this;
}
Flag& Flag::between(int min, int max) {
    option_->check(CLI::Range(min, max));
    return *this;
}
Flag& Flag::between(double min, double max) {
    option_->check(CLI::Range(min, max));
    return *this;
}
Flag& Flag::positive() {
    option_->check(CLI::PositiveNumber);
    return *this;
}
Flag& Flag::oneOf(const std::vector<std::string>& words) {
    option_->check(CLI::IsMember(words));
    return *this;
}
Flag& Flag::existingFile() {
    option_->check(CLI::ExistingFile);
    return *this;
}
Flag& Flag::existingFolder() {
    option_->check(CLI::ExistingDirectory);
    return *this;
}
Flag& Flag::existingPath() {
    option_->check(CLI::ExistingPath);
    return *this;
}
Flag& Flag::extension(const std::vector<std::string>& extensions) {
    std::vector<std::string> named = extensions;
    named.erase(std::remove(named.begin(), named.end(), ""), named.end());
    return check([extensions, named](const std::string& name) -> std::string {
        const std::string own = fs::path(name).extension().string();
        const bool is_one =
            std::find(extensions.begin(), extensions.end(), own) != extensions.end();
        return is_one ? "" : name + " does not end in " + CLI::detail::join(named, ", ");
    });
}
Flag& Flag::check(std::function<std::string(const std::string&)> errorOf) {
    option_->check(CLI::Validator(std::move(errorOf), ""));
    return *this;
}
Flag& Flag::transform(std::function<std::string(const std::string&)> rewrite) {
    option_->transform(std::move(rewrite));
    return *this;
}
Flag& Flag::group(const std::string& name) {
    option_->group(name);
    return *this;
}
Flag& Flag::valueName(const std::string& name) {
    option_->option_text(name);
    return *this;
}
Flag& Flag::showDefault() {
    option_->capture_default_str();
    return *this;
}
Flag& Flag::mayBeEmpty() {
    option_->get_validator(kNotEmpty)->active(false);
    return *this;
}
bool Flag::isGiven() const { return option_->count() > 0; }

namespace {

/// The number type in std::optional<float> or std::vector<double>; other types are unchanged.
template <class Value>
struct NumberIn {
    using Type = Value;
};
template <class Number>
struct NumberIn<std::optional<Number>> {
    using Type = Number;
};
template <class Number>
struct NumberIn<std::vector<Number>> {
    using Type = Number;
};

/// Returns the error in the text of a number, or "". CLI11 accepts nan, which passes its range
/// checks, and wraps -1 and 99999999999999999999 to other unsigned numbers.
template <class Number>
std::string errorOfNumber(const std::string& text) {
    const bool has_plus = text.size() > 1 && text[0] == '+' && text[1] != '-';
    const auto number = numberFrom<Number>(std::string_view(text).substr(has_plus ? 1 : 0));
    if constexpr (std::is_floating_point_v<Number>) {
        return number && std::isfinite(*number) ? "" : "'" + text + "' is not a finite number";
    } else {
        using Limits = std::numeric_limits<Number>;
        if (number) return "";
        return "'" + text + "' is not a whole number from " + std::to_string(Limits::min()) +
               " to " + std::to_string(Limits::max());
    }
}

}  // namespace

template <class Value>
Flag Command::option(const std::string& names, Value& value, const std::string& help) {
    CLI::Option* const option = app_->add_option(names, value, help);
    using Number = typename NumberIn<Value>::Type;
    constexpr bool is_path =
        std::is_same_v<Value, fs::path> || std::is_same_v<Value, std::vector<fs::path>>;
    option->option_text(std::is_floating_point_v<Number> ? "X"
                        : std::is_integral_v<Number>     ? "N"
                        : is_path                        ? "PATH"
                                                         : "NAME");
    if constexpr (std::is_arithmetic_v<Number>) {
        option->check(CLI::Validator(errorOfNumber<Number>, ""));
    } else {
        // Otherwise an unset variable in a script would silently drop an output.
        const auto errorOf = [](const std::string& text) {
            return text.empty() ? std::string("must not be empty") : std::string();
        };
        option->check(CLI::Validator(errorOf, "", kNotEmpty));
    }
    return Flag(*option);
}
template Flag Command::option(const std::string&, std::string&, const std::string&);
template Flag Command::option(const std::string&, fs::path&, const std::string&);
template Flag Command::option(const std::string&, int&, const std::string&);
template Flag Command::option(const std::string&, std::size_t&, const std::string&);
template Flag Command::option(const std::string&, float&, const std::string&);
template Flag Command::option(const std::string&, double&, const std::string&);
template Flag Command::option(const std::string&, std::optional<float>&, const std::string&);
template Flag Command::option(const std::string&, std::vector<std::string>&, const std::string&);
template Flag Command::option(const std::string&, std::vector<fs::path>&, const std::string&);
template Flag Command::option(const std::string&, std::vector<double>&, const std::string&);

Flag Command::flag(const std::string& names, bool& value, const std::string& help) {
    return Flag(*app_->add_flag(names, value, help));
}

Flag Command::printer(const std::string& names, std::function<void()> print,
                      const std::string& help) {
    const auto stop = [print = std::move(print)] {
        print();
        throw CLI::Success();
    };
    return Flag(*app_->add_flag_callback(names, stop, help));
}

Flag Command::choice(const std::string& names, const std::vector<std::string>& words,
                     const std::string& help, std::function<void(std::size_t)> choose) {
    const auto place = [words](const std::string& word) {
        return static_cast<std::size_t>(std::find(words.begin(), words.end(), word) -
                                        words.begin());
    };
    const std::function<void(const std::string&)> set =
        [place, choose = std::move(choose)](const std::string& word) { choose(place(word)); };
    const auto errorOf = [place, words](const std::string& word) {
        return place(word) < words.size()
                   ? ""
                   : "'" + word + "' is not one of " + CLI::detail::join(words, ", ");
    };
    return Flag(*app_->add_option_function(names, set, help)
                     ->check(CLI::Validator(errorOf, ""))
                     ->option_text(CLI::detail::join(words, "|")));
}

void Command::does(std::function<int()> work) {
    app_->callback([work = std::move(work), chosen = chosen_] {
        *chosen = [work] {
            catchSignals();
            return work();
        };
    });
}

namespace {

/// The error message if no valid subcommand was given.
std::string subcommandsOf(const CLI::App& app, const std::string& program) {
    const std::vector<std::string> unknown = app.remaining();
    std::string text =
        unknown.empty() ? "no command given" : "'" + unknown[0] + "' is not a command";
    const char* before = "; commands: ";
    for (const CLI::App* command : app.get_subcommands(nullptr)) {
        text += before + command->get_name();
        before = ", ";
    }
    return text + " (" + program + " --help shows details)";
}

}  // namespace

int guarded(int argc, char** argv, int (*program)(int argc, char** argv)) noexcept {
    std::signal(SIGCHLD, SIG_DFL);  // waiting for children fails if SIGCHLD is ignored
    try {
        return program(argc, argv);
    } catch (const std::bad_alloc&) {
        std::fprintf(stderr, "%s: out of memory\n", program_invocation_short_name);
    } catch (const std::exception& e) {
        std::cerr << program_invocation_short_name << ": " << e.what() << std::endl;
    } catch (...) {
        std::fprintf(stderr, "%s: unknown error\n", program_invocation_short_name);
    }
    return kFailed;
}

Program::Program(std::string name, const std::string& description)
    : Program(std::make_unique<CLI::App>(description), std::move(name)) {}
Program::Program(std::unique_ptr<CLI::App> app, std::string name)
    : Command(*app, work_), owned_(std::move(app)), name_(std::move(name)) {
    ignoreWriteSignals();
    keepTerminalSafe();
    app_->formatter(std::make_shared<HelpText>());  // subcommands inherit it
}
Program::~Program() = default;

void Program::footer(const std::string& text) { app_->footer(text); }
void Program::version(const std::string& version) {
    app_->set_version_flag("--version", name_ + " " + version);
}

Command Program::subcommand(const std::string& name, const std::string& help) {
    app_->require_subcommand(1);
    return Command(*app_->add_subcommand(name, help), work_);
}

int Program::fail(int exit_code, const std::string& message) const {
    std::cerr << name_ << ": " << oneLine(message) << "\n";
    return exit_code;
}

/// Checks that standard output was written completely.
int Program::flushed(int exit_code) const {
    if (std::fflush(stdout) == 0 && std::cout.flush()) return exit_code;
    return fail(kFailed, "cannot write to standard output");
}

int Program::run(int argc, char** argv, const std::function<int()>& work) {
    constexpr double kGb = 1e9;
    memory_gb_ = static_cast<double>(machineBytes()) / 2 / kGb;
    option("--memory-limit", memory_gb_, "memory limit in GB (default: half of the machine's)")
        .between(0.05, 1e6)
        .valueName("GB");
    try {
        app_->parse(argc, argv);
        limitMemory(static_cast<std::uint64_t>(memory_gb_ * kGb));
        return flushed(work ? work() : work_());
    } catch (const CLI::Success& e) {  // --help, --version
        app_->exit(e);
        return flushed(kDone);
    } catch (const CLI::ParseError& e) {
        const bool lacks_subcommand =
            !app_->get_subcommands(nullptr).empty() && app_->get_subcommands().empty();
        if (lacks_subcommand) return fail(kWrongUsage, subcommandsOf(*app_, name_));
        app_->exit(e);
        return kWrongUsage;
    } catch (const UsageError& e) {
        app_->exit(CLI::ValidationError(e.what()));
        return kWrongUsage;
    } catch (const std::exception& e) {
        return fail(kFailed, messageOf(e));
    }
}

std::string Program::messageOf(const std::exception& e) {
    if (dynamic_cast<const std::bad_alloc*>(&e) != nullptr) return outOfMemory();
    if (const auto* of_file = dynamic_cast<const fs::filesystem_error*>(&e)) {
        return of_file->path1().string() + ": " + of_file->code().message();
    }
    return e.what();
}

}  // namespace hagen::base
