#include <hagen/base/CommandLine.h>

#include <sys/stat.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cerrno>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <iostream>
#include <limits>
#include <new>
#include <sstream>
#include <string_view>
#include <type_traits>

#include <hagen/base/Interrupt.h>
#include <hagen/base/MemoryLimit.h>
#include <hagen/base/NumberText.h>
#include <hagen/base/OutputPath.h>
#include <hagen/base/Terminal.h>
#include "base/command_line/Stacks.h"
#include "base/command_line/StandardStreams.h"

namespace hagen::base {

namespace fs = std::filesystem;

namespace {

constexpr std::size_t kHelpWidth = 80, kHelpColumn = 30;
constexpr const char* kNotEmpty = "not empty";  // a check's name

/// Breaks a line of --help between words. Its continuations begin where descriptions do.
std::string wrapped(std::string line) {
    std::string lines;
    while (line.size() > kHelpWidth) {
        const std::size_t end = line.rfind(' ', kHelpWidth);
        const bool has_word = line.find_first_not_of(' ') < end && end != std::string::npos;
        // A word that is longer than a line stays whole.
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

/// CLI11's text of --help in lines of a terminal's width.
class HelpText : public CLI::Formatter {
 public:
    HelpText() { column_width(kHelpColumn); }

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
Flag& Flag::between(int least, int most) {
    option_->check(CLI::Range(least, most));
    return *this;
}
Flag& Flag::between(double least, double most) {
    option_->check(CLI::Range(least, most));
    return *this;
}
Flag& Flag::positive() {
    option_->check(CLI::PositiveNumber);
    return *this;
}
Flag& Flag::notNegative() {
    option_->check(CLI::NonNegativeNumber);
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
Flag& Flag::check(std::function<std::string(const std::string&)> errorOf, const std::string& type) {
    option_->check(CLI::Validator(std::move(errorOf), type));
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

/// The number in a value, as in std::optional<float> and std::vector<double>; otherwise the value.
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

/// What is wrong with the text of a number; "" if nothing is. CLI11 takes nan, which passes each of
/// its checks of ranges, and takes -1 and 99999999999999999999 for other unsigned numbers.
template <class Number>
std::string errorOfNumber(const std::string& text) {
    const bool has_plus = text.size() > 1 && text[0] == '+' && text[1] != '-';
    const auto number = base::numberFrom<Number>(std::string_view(text).substr(has_plus ? 1 : 0));
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
    if constexpr (std::is_arithmetic_v<Number>) {
        option->check(CLI::Validator(errorOfNumber<Number>, ""));
    } else {
        // A script's variable that is not set: an output that it names would be missing.
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
    return Flag(*app_->add_option_function(names, set, help)->check(CLI::Validator(errorOf, "")));
}

void Command::hide() { app_->group(""); }

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
    const char* before = "; there are ";
    const auto is_shown = [](const CLI::App* command) { return !command->get_group().empty(); };
    for (const CLI::App* command : app.get_subcommands(is_shown)) {
        text += before + command->get_name();
        before = ", ";
    }
    return text + " (" + program + " --help shows details)";
}

bool isFlag(const std::string& word) { return word.size() > 1 && word[0] == '-'; }

/// The command that was given, or the program.
const CLI::App& givenCommand(const CLI::App& app) {
    const std::vector<const CLI::App*> given =
        app.get_subcommands([](const CLI::App* command) { return command->parsed(); });
    return given.empty() ? app : *given.back();
}

/// What to do with a value that belongs to no flag; empty if there is nothing to say.
std::string hintOn(const std::string& value, const std::vector<std::string>& words,
                   const CLI::App& app) {
    const auto at = std::find(words.begin(), words.end(), value);
    const auto before = std::find_if(std::make_reverse_iterator(at), words.rend(), isFlag);
    const CLI::Option* const flag =
        before == words.rend() ? nullptr : app.get_option_no_throw(*before);
    if (flag != nullptr && flag->get_items_expected_max() > 1 && before.base() != at) {
        return "to name several, repeat the flag: " + *before + " " + *before.base() + " " +
               *before + " " + value;
    }
    const bool is_of_unknown_flag = before != words.rend() && before.base() == at;
    if (flag == nullptr && is_of_unknown_flag) return "";
    const CLI::Option* const input = app.get_option_no_throw("--input");
    if (input != nullptr && input->count() == 0) return "use -i " + value;
    return "";
}

/// The error message about arguments that are no flags and values of none.
std::string extrasText(const CLI::App& app, int argc, char** argv) {
    const std::vector<std::string> words(argv + 1, argv + argc);
    std::vector<std::string> extras = app.remaining(true);
    // CLI11 does not keep the order.
    std::stable_sort(extras.begin(), extras.end(), [&](const auto& a, const auto& b) {
        return std::find(words.begin(), words.end(), a) < std::find(words.begin(), words.end(), b);
    });
    std::string text, hint;
    for (const std::string& extra : extras) {
        text += (text.empty() ? "" : ", ") + extra;
        if (hint.empty() && !isFlag(extra)) hint = hintOn(extra, words, givenCommand(app));
    }
    const bool is_one = extras.size() == 1;
    text = std::string("The following argument") + (is_one ? " was" : "s were") +
           " not expected: " + text;
    return hint.empty() ? text : text + "; " + hint;
}

}  // namespace

namespace {

int caught(const std::function<int()>& program) noexcept {
    try {
        return program();
    } catch (const std::bad_alloc&) {
        std::fprintf(stderr, "%s: out of memory\n", program_invocation_short_name);
    } catch (const std::exception& e) {
        // Perhaps with a text of the input, so by the stream that keeps terminals safe.
        std::cerr << program_invocation_short_name << ": " << e.what() << std::endl;
    } catch (...) {
        std::fprintf(stderr, "%s: ended by an unknown error\n", program_invocation_short_name);
    }
    return kFailed;
}

}  // namespace

int guarded(int argc, char** argv, int (*program)(int argc, char** argv)) noexcept {
    // Who starts a program may have it ignore this; nobody could then wait for its children.
    std::signal(SIGCHLD, SIG_DFL);
    const auto call = [&] { return program(argc, argv); };
    const auto work = [&] { return caught(std::cref(call)); };  // a reference takes no memory
    return withRoomyStacks(std::cref(work));
}

namespace {

/// Outputs can be read and removed by who writes them, whatever the umask.
void keepOwnersRights() {
    constexpr mode_t kOwner = S_IRWXU;
    umask(umask(0) & ~kOwner);
}

}  // namespace

Program::Program(std::string name, const std::string& description)
    : Program(std::make_unique<CLI::App>(description), std::move(name)) {}
Program::Program(std::unique_ptr<CLI::App> app, std::string name)
    : Command(*app, work_), owned_(std::move(app)), name_(std::move(name)) {
    reserveStandardStreams();
    ignoreWriteSignals();
    keepOwnersRights();
    keepTerminalSafe();
    app_->formatter(std::make_shared<HelpText>());  // subcommands inherit it
}
Program::~Program() = default;

void Program::footer(const std::string& text) { app_->footer(text); }
void Program::version(const std::string& version) {
    app_->set_version_flag("--version", name_ + " " + version);
}
void Program::prints(const std::string& what) { printed_ = help_ = what; }

Command Program::subcommand(const std::string& name, const std::string& help) {
    app_->require_subcommand(1);
    return Command(*app_->add_subcommand(name, help), work_);
}

int Program::fail(int exit_code, const std::string& message) const {
    std::cerr << name_ << ": " << oneLine(message) << "\n";
    return exit_code;
}

/// Checks that standard output was written completely.
int Program::printed(int exit_code, const std::string& what) const {
    if (std::fflush(stdout) == 0 && std::cout.flush()) return exit_code;
    return fail(kFailed, "the " + what + " cannot be printed");
}

int Program::run(int argc, char** argv, const std::function<int()>& work) {
    constexpr double kGb = 1e9;
    memory_gb_ = static_cast<double>(base::machineBytes()) / 2 / kGb;
    option("--memory-limit", memory_gb_,
           "memory that the program may take, in GB (default: half of the machine's)")
        .between(0.05, 1e6)
        .valueName("GB");
    try {
        app_->parse(argc, argv);
        base::limitMemory(static_cast<std::uint64_t>(memory_gb_ * kGb));
        return printed(work ? work() : work_(), printed_);
    } catch (const CLI::Success& e) {  // --help, --version
        app_->exit(e);
        return printed(kDone, help_);
    } catch (const CLI::ParseError& e) {
        const bool lacks_subcommand =
            !app_->get_subcommands(nullptr).empty() && app_->get_subcommands().empty();
        if (lacks_subcommand) return fail(kWrongUsage, subcommandsOf(*app_, name_));
        if (dynamic_cast<const CLI::ExtrasError*>(&e) != nullptr) {
            app_->exit(CLI::ValidationError(extrasText(*app_, argc, argv)));
        } else {
            app_->exit(e);
        }
        return kWrongUsage;
    } catch (const UsageError& e) {
        app_->exit(CLI::ValidationError(e.what()));
        return kWrongUsage;
    } catch (const std::exception& e) {
        return fail(kFailed, messageOf(e));
    }
}

std::string Program::messageOf(const std::exception& e) {
    if (dynamic_cast<const std::bad_alloc*>(&e) != nullptr) {
        return base::outOfMemory();
    }
    if (const auto* of_file = dynamic_cast<const fs::filesystem_error*>(&e)) {
        return of_file->path1().string() + ": " + of_file->code().message();
    }
    return e.what();
}

void tellLeftBehind(const std::vector<std::filesystem::path>& outputs) {
    const std::string left = base::leftBehind(outputs);
    if (!left.empty()) std::cerr << left << "\n";
}

}  // namespace hagen::base
