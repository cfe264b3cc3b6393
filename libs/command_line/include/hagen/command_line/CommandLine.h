#pragma once
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace CLI {
class App;
class Option;
}  // namespace CLI

/// Command lines of the programs, read by CLI11. CommandLine.cpp alone includes that, which is slow
/// to compile.
namespace hagen::command_line {

/// Exit codes of all programs.
constexpr int kDone = 0, kFailed = 1, kWrongUsage = 2;

/// Wrong usage that shows only once all flags are read. Programs print its message and how to get
/// help, and end with kWrongUsage.
struct UsageError : std::runtime_error {
    using std::runtime_error::runtime_error;
    UsageError(const std::string& flag, const std::string& message)
        : std::runtime_error(flag + ": " + message) {}
};

/// A flag of a command. Each function narrows what the flag takes, or changes how --help shows it,
/// and returns the flag.
class Flag {
 public:
    explicit Flag(CLI::Option& option) : option_(&option) {}

    Flag& required();
    Flag& once();                ///< one value each time it is given; may be repeated
    Flag& delimiter(char mark);  ///< splits one argument into values
    Flag& needs(const Flag& other);
    Flag& between(int least, int most);
    Flag& between(double least, double most);
    Flag& positive();
    Flag& notNegative();
    Flag& oneOf(const std::vector<std::string>& words);
    Flag& existingFile();
    Flag& existingFolder();
    Flag& existingPath();
    /// `errorOf` answers what is wrong with a value, or nothing; `type` is shown by --help.
    Flag& check(std::function<std::string(const std::string&)> errorOf, const std::string& type);
    /// Takes values as another text, before they are checked.
    Flag& transform(std::function<std::string(const std::string&)> rewrite);

    Flag& group(const std::string& name);      ///< heading of --help
    Flag& valueName(const std::string& name);  ///< instead of the type that --help shows
    Flag& showDefault();                       ///< what the variable holds now

    bool isGiven() const;  ///< once the command line is read

 private:
    CLI::Option* option_;
};

/// A program, or one of its subcommands: flags that set variables. The variables must outlive it.
class Command {
 public:
    /// `names` as "-o,--output", or "DIR" for an argument by its place. Value: std::string,
    /// std::filesystem::path, int, std::size_t, float, double, std::optional<float>, or
    /// std::vector of std::string, std::filesystem::path or double.
    template <class Value>
    Flag option(const std::string& names, Value& value, const std::string& help);
    Flag flag(const std::string& names, bool& value, const std::string& help);
    /// A word that stands for a value.
    template <class Value>
    Flag choice(const std::string& names, Value& value,
                const std::vector<std::pair<std::string, Value>>& meanings,
                const std::string& help) {
        std::vector<std::string> words;
        for (const auto& meaning : meanings) words.push_back(meaning.first);
        return choice(names, words, help,
                      [&value, meanings](std::size_t i) { value = meanings[i].second; });
    }
    /// A flag that prints something and ends the program.
    Flag printer(const std::string& names, std::function<void()> print, const std::string& help);

    void hide();  ///< from --help
    /// What a subcommand does, with signals caught (Interrupt.h); answers the exit code.
    void does(std::function<int()> work);

 protected:
    Command(CLI::App& app, std::function<int()>& chosen) : app_(&app), chosen_(&chosen) {}
    CLI::App* app_;

 private:
    friend class Program;
    Flag choice(const std::string& names, const std::vector<std::string>& words,
                const std::string& help, std::function<void(std::size_t)> choose);
    std::function<int()>* chosen_;  ///< work of the subcommand that was given
};

/// A program with --help.
class Program : public Command {
 public:
    Program(std::string name, const std::string& description);
    ~Program();

    void footer(const std::string& text);
    void version(const std::string& version);  ///< --version
    /// What it prints, for the message that this failed (default: "summary", or "text" of --help).
    void prints(const std::string& what);
    Command subcommand(const std::string& name, const std::string& help);

    /// Reads the command line and does the work, which answers the exit code; without `work` that
    /// of the subcommand. Prints errors, and returns the program's exit code.
    int run(int argc, char** argv, const std::function<int()>& work = nullptr);
    /// Prints a message behind the program's name; answers the exit code.
    int fail(int exit_code, const std::string& message) const;

 private:
    explicit Program(std::unique_ptr<CLI::App> app, std::string name);
    int printed(int exit_code, const std::string& what) const;

    std::unique_ptr<CLI::App> owned_;
    std::function<int()> work_;
    std::string name_, printed_ = "summary", help_ = "text";
};

}  // namespace hagen::command_line
