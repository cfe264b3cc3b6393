#pragma once
#include <filesystem>
#include <functional>
#include <memory>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace CLI {
class App;
class Option;
}  // namespace CLI

/// Command lines of the programs, parsed by CLI11. Only CommandLine.cpp includes CLI11, because it
/// is slow to compile.
namespace hagen::base {

constexpr int kDone = 0, kFailed = 1, kWrongUsage = 2;

/// Returns the exit code of `program`. If `program` throws, prints the error and returns kFailed.
int guarded(int argc, char** argv, int (*program)(int argc, char** argv)) noexcept;

/// Wrong usage detected after parsing. The program prints the message with a hint to --help and
/// exits with kWrongUsage.
struct UsageError : std::runtime_error {
    using std::runtime_error::runtime_error;
    UsageError(const std::string& flag, const std::string& message)
        : std::runtime_error(flag + ": " + message) {}
};

/// A flag of a command. Each function sets a property of the flag and returns the flag.
class Flag {
 public:
    explicit Flag(CLI::Option& option) : option_(&option) {}

    Flag& required();
    Flag& once();                ///< one value per occurrence; may be repeated
    Flag& delimiter(char mark);  ///< splits one argument into values
    Flag& needs(const Flag& other);
    Flag& between(int min, int max);
    Flag& between(double min, double max);
    Flag& positive();
    Flag& oneOf(const std::vector<std::string>& words);
    Flag& existingFile();
    Flag& existingFolder();
    Flag& existingPath();
    /// The name of a file must have one of these extensions (".mcap"; "": none).
    Flag& extension(const std::vector<std::string>& extensions);
    /// `errorOf` returns the error in a value, or "".
    Flag& check(std::function<std::string(const std::string&)> errorOf);
    Flag& mayBeEmpty();  ///< texts must not be empty by default
    /// Rewrites values before they are checked.
    Flag& transform(std::function<std::string(const std::string&)> rewrite);

    Flag& group(const std::string& name);      ///< heading in --help
    Flag& valueName(const std::string& name);  ///< replaces NAME, PATH, N or X in --help
    Flag& showDefault();                       ///< shows the variable's current value in --help

    bool isGiven() const;  ///< valid after parsing

 private:
    CLI::Option* option_;
};

/// A program or subcommand with flags that set variables. The variables must outlive it.
class Command {
 public:
    /// `names` as in "-o,--output", or "DIR" for a positional argument. Value: std::string,
    /// std::filesystem::path, int, std::size_t, float, double, std::optional<float>, or
    /// std::vector of std::string, std::filesystem::path or double.
    template <class Value>
    Flag option(const std::string& names, Value& value, const std::string& help);
    Flag flag(const std::string& names, bool& value, const std::string& help);
    /// Adds a flag that accepts one of several words, each with its value.
    template <class Value>
    Flag choice(const std::string& names, Value& value,
                const std::vector<std::pair<std::string, Value>>& meanings,
                const std::string& help) {
        std::vector<std::string> words;
        for (const auto& meaning : meanings) words.push_back(meaning.first);
        return choice(names, words, help,
                      [&value, meanings](std::size_t i) { value = meanings[i].second; });
    }
    /// Adds a flag that prints something and exits.
    Flag printer(const std::string& names, std::function<void()> print, const std::string& help);

    /// Sets the function that runs a subcommand and returns the exit code. Catches signals
    /// (Interrupt.h).
    void does(std::function<int()> work);

 protected:
    Command(CLI::App& app, std::function<int()>& chosen) : app_(&app), chosen_(&chosen) {}
    CLI::App* app_;

 private:
    friend class Program;
    Flag choice(const std::string& names, const std::vector<std::string>& words,
                const std::string& help, std::function<void(std::size_t)> choose);
    std::function<int()>* chosen_;  ///< work of the selected subcommand
};

/// A program with a --help flag.
class Program : public Command {
 public:
    Program(std::string name, const std::string& description);
    ~Program();

    void footer(const std::string& text);
    void version(const std::string& version);  ///< adds --version
    Command subcommand(const std::string& name, const std::string& help);
    /// Parses the command line and runs `work` (by default, the selected subcommand). Prints errors
    /// and returns the exit code.
    int run(int argc, char** argv, const std::function<int()>& work = nullptr);
    /// Prints the program's name and a message; returns the exit code.
    int fail(int exit_code, const std::string& message) const;
    /// The message printed by run() for an exception.
    static std::string messageOf(const std::exception& e);

 private:
    explicit Program(std::unique_ptr<CLI::App> app, std::string name);
    int flushed(int exit_code) const;

    std::unique_ptr<CLI::App> owned_;
    std::function<int()> work_;
    std::string name_;
    double memory_gb_ = 0;
};

}  // namespace hagen::base
