#include "Manual.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cctype>
#include <sstream>
#include <utility>
#include <vector>

namespace hagen::command_line {

namespace {

using Options = std::vector<const CLI::Option*>;
using Apps = std::vector<const CLI::App*>;

std::string replaced(std::string text, const std::string& from, const std::string& to) {
    for (std::size_t at = 0; (at = text.find(from, at)) != std::string::npos; at += to.size()) {
        text.replace(at, from.size(), to);
    }
    return text;
}

std::string upper(std::string text) {
    std::transform(text.begin(), text.end(), text.begin(),
                   [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
    return text;
}

std::string joined(const std::vector<std::string>& words, const std::string& between) {
    return CLI::detail::join(words, between);
}

/// What --help shows.
Options flagsOf(const CLI::App& app) {
    return app.get_options([](const CLI::Option* option) {
        return option->nonpositional() && !option->get_group().empty();
    });
}
Options positionalsOf(const CLI::App& app) {
    return app.get_options([](const CLI::Option* option) {
        return option->get_positional() && !option->get_group().empty();
    });
}
Apps commandsOf(const CLI::App& app) {
    return app.get_subcommands(
        [](const CLI::App* command) { return !command->get_group().empty(); });
}

/// The names of a flag with their dashes, short ones first.
std::vector<std::string> namesOf(const CLI::Option& option) {
    std::vector<std::string> names;
    for (const std::string& name : option.get_snames()) names.push_back("-" + name);
    for (const std::string& name : option.get_lnames()) names.push_back("--" + name);
    return names;
}
std::vector<std::string> namesOf(const Options& options) {
    std::vector<std::string> all;
    for (const CLI::Option* option : options) {
        const std::vector<std::string> names = namesOf(*option);
        all.insert(all.end(), names.begin(), names.end());
    }
    return all;
}

bool takesValue(const CLI::Option& option) { return option.get_items_expected_max() > 0; }
bool isRepeatable(const CLI::Option& option) { return option.get_items_expected_max() > 1; }

/// The words that a flag takes; empty if it takes others.
std::vector<std::string> choicesOf(const CLI::Option& option) {
    const std::string& text = option.get_option_text();
    if (text.find('|') != std::string::npos) return CLI::detail::split(text, '|');
    const std::string type = option.get_type_name();
    const std::size_t begin = type.find('{'), end = type.find('}');
    if (begin == std::string::npos || end == std::string::npos) return {};
    std::vector<std::string> words =
        CLI::detail::split(type.substr(begin + 1, end - begin - 1), ',');
    for (std::string& word : words) CLI::detail::trim(word);
    return words;
}

/// Those that a shell completes: a word with a space would need quotes.
std::vector<std::string> completedChoicesOf(const CLI::Option& option) {
    std::vector<std::string> words = choicesOf(option);
    words.erase(
        std::remove_if(words.begin(), words.end(),
                       [](const std::string& word) { return word.find(' ') != std::string::npos; }),
        words.end());
    return words;
}

bool isNumber(const CLI::Option& option) {
    const std::string type = option.get_type_name();
    return type.rfind("INT", 0) == 0 || type.rfind("UINT", 0) == 0 || type.rfind("FLOAT", 0) == 0;
}

/// The name of a flag's value.
std::string valueOf(const CLI::Option& option) {
    if (!option.get_option_text().empty()) return option.get_option_text();
    if (const auto choices = choicesOf(option); !choices.empty()) return joined(choices, "|");
    const std::string type = option.get_type_name();
    if (isNumber(option)) return type.rfind("FLOAT", 0) == 0 ? "X" : "N";
    for (const char* kind : {"FILE", "DIR", "PATH"}) {
        if (type.find(std::string(":") + kind) != std::string::npos) return kind;
    }
    return "TEXT";
}

/// What --help shows beside the name: whether it is required, the range, the default.
std::string conditionsOf(const CLI::Option& option) {
    std::string text;
    if (option.get_required()) text += " Required.";
    for (const CLI::Option* other : option.get_needs()) {
        text += " Needs " + other->get_name(false, false) + ".";
    }
    if (const auto at = option.get_type_name().find(" in ["); at != std::string::npos) {
        const std::string range = option.get_type_name().substr(at + 4);
        text += " Within " + range.substr(0, range.find(']') + 1) + ".";
    }
    std::string standard = option.get_default_str();
    if (!standard.empty() && standard.front() == '[') {  // a list
        standard = standard.substr(1, standard.size() - 2);
    }
    if (!standard.empty()) text += " Default: " + standard + ".";
    return text;
}

std::string sentence(std::string text) {
    while (!text.empty() && std::isspace(static_cast<unsigned char>(text.back()))) text.pop_back();
    return text.empty() || text.back() == '.' ? text : text + ".";
}

// The manual page.

std::string roff(std::string text) {
    text = replaced(text, "\\", "\\e");
    text = replaced(text, "-", "\\-");
    text = replaced(text, "'", "\\(aq");
    text = replaced(text, "`", "\\(ga");
    text = replaced(text, "^", "\\(ha");
    text = replaced(text, "~", "\\(ti");
    return text;
}
/// Text at the beginning of a line.
std::string roffLine(const std::string& text) {
    return (text.rfind('.', 0) == 0 ? "\\&" : "") + roff(text) + "\n";
}

std::string roffOf(const Options& options) {
    std::string text;
    for (const CLI::Option* option : options) {
        std::vector<std::string> names;
        for (const std::string& name : namesOf(*option)) {
            names.push_back("\\fB" + roff(name) + "\\fR");
        }
        const std::string value = "\\fI" + roff(valueOf(*option)) + "\\fR";
        if (names.empty()) {
            names.push_back("\\fI" + roff(option->get_name(true, false)) + "\\fR");
        } else if (takesValue(*option)) {
            names.back() += " " + value;
        }
        text += ".TP\n" + joined(names, ", ") + "\n" +
                roffLine(sentence(option->get_description()) + conditionsOf(*option));
    }
    return text;
}

/// Flags under the headings of --help.
std::string roffGroups(const CLI::App& app, bool with_headings) {
    std::string text = roffOf(positionalsOf(app));
    for (const std::string& group : app.get_groups()) {
        Options options = flagsOf(app);
        options.erase(std::remove_if(options.begin(), options.end(),
                                     [&](auto* option) { return option->get_group() != group; }),
                      options.end());
        if (options.empty()) continue;
        if (with_headings && group != "Options") text += ".SS " + roff(group) + "\n";
        text += roffOf(options);
    }
    return text;
}

std::string synopsis(const CLI::App& app, const std::string& words) {
    std::string text = "\\fB" + roff(words) + "\\fR";
    if (!flagsOf(app).empty()) text += " [\\fIOPTION\\fR]...";
    for (const CLI::Option* option : positionalsOf(app)) {
        text += " \\fI" + roff(option->get_name(true, false)) + "\\fR";
    }
    return text + "\n";
}

bool takesSettings(const CLI::App& app) { return app.get_option_no_throw("--config") != nullptr; }

/// The footer of --help: prose, examples, exit codes.
struct Footer {
    std::vector<std::string> prose, examples;
    std::string exit_codes;
};
Footer footerOf(const CLI::App& app) {
    Footer footer;
    std::istringstream lines(app.get_footer());
    bool is_example = false;
    for (std::string line; std::getline(lines, line);) {
        if (line.rfind("Example", 0) == 0) {
            is_example = true;
        } else if (line.rfind("Exit codes: ", 0) == 0) {
            footer.exit_codes = line.substr(12);
        } else {
            (is_example ? footer.examples : footer.prose).push_back(line);
        }
    }
    return footer;
}

}  // namespace

std::string manualPage(const CLI::App& app, const std::string& program, const std::string& date) {
    const Footer footer = footerOf(app);
    std::string summary = app.get_description();
    if (!summary.empty() && summary.back() == '.') summary.pop_back();
    const std::string version = replaced(app.version(), program + " ", "");
    const Apps commands = commandsOf(app);

    std::string page = ".\\\" Generated by the program itself.\n.TH " + roff(upper(program)) +
                       " 1 " + date + " \"Hagen " + version + "\" \"User Commands\"\n";
    page += ".SH NAME\n" + roff(program) + " \\- " + roff(summary) + "\n.SH SYNOPSIS\n";
    if (commands.empty()) page += synopsis(app, program);
    for (const CLI::App* command : commands) {
        page += synopsis(*command, program + " " + command->get_name()) + ".br\n";
    }
    if (!commands.empty()) page += synopsis(app, program);
    page += ".SH DESCRIPTION\n" + roffLine(sentence(app.get_description()));
    for (const std::string& line : footer.prose) page += roffLine(line);
    page += ".SH OPTIONS\n" + roffGroups(app, true);
    bool takes_settings = takesSettings(app);
    if (!commands.empty()) page += ".SH COMMANDS\n";
    for (const CLI::App* command : commands) {
        page += ".SS " + roff(command->get_name()) + "\n" +
                roffLine(sentence(command->get_description())) + roffGroups(*command, false);
        takes_settings = takes_settings || takesSettings(*command);
    }
    if (takes_settings) {
        page +=
            ".SH ENVIRONMENT\n.TP\n\\fBHAGEN_CONFIG_PATH\\fR\nFolders that are searched for "
            "presets first, separated by colons.\n";
    }
    page += ".SH \"EXIT STATUS\"\n" +
            roffLine(footer.exit_codes.empty() ? "0 success, 1 failed while running, 2 wrong usage."
                                               : footer.exit_codes);
    if (!footer.examples.empty()) {
        page += ".SH EXAMPLES\n.nf\n";
        for (const std::string& line : footer.examples) page += roffLine(line);
        page += ".fi\n";
    }
    page += ".SH \"SEE ALSO\"\n";
    std::string others;
    for (const char* other : {"live-segment", "octomap-compare", "rawlog-segment",
                              "rawlog-simulate", "segmentation-evaluate"}) {
        if (other == program) continue;
        others += (others.empty() ? ".BR " : " ,\n.BR ") + roff(other) + " (1)";
    }
    return page + others + "\n";
}

namespace {

// Completions.

/// A name of a shell function.
std::string functionName(const std::string& program) { return "_" + replaced(program, "-", "_"); }

std::string quoted(const std::string& text) { return "'" + replaced(text, "'", "'\\''") + "'"; }

/// Lists the names of presets in the folders where the programs look
/// (hagen/settings/Presets.h).
std::string presetsFunction(const std::string& function, const std::string& folders) {
    return function + "_presets() {\n    local folder file\n    for folder in " + folders +
           "; do\n        for file in \"$folder\"/*.yaml; do\n"
           "            [ -f \"$file\" ] || continue\n"
           "            file=${file##*/}\n            echo \"${file%.yaml}\"\n"
           "        done\n    done\n}\n\n";
}

bool takesPreset(const CLI::Option& option) { return option.check_name("--config"); }

/// One branch of bash's `case` on the command, the previous word being a flag.
std::string bashValues(const CLI::App& app, const std::string& command,
                       const std::string& function) {
    std::string text;
    for (const CLI::Option* option : flagsOf(app)) {
        if (!takesValue(*option)) continue;
        std::vector<std::string> patterns;
        for (const std::string& name : namesOf(*option)) patterns.push_back(command + "," + name);
        const std::string pattern = "        " + joined(patterns, "|") + ")\n            ";
        const std::vector<std::string> choices = completedChoicesOf(*option);
        if (!choices.empty()) {
            text += pattern + "mapfile -t COMPREPLY < <(compgen -W " +
                    quoted(joined(choices, " ")) + " -- \"$cur\")\n            return\n" +
                    "            ;;\n";
        } else if (takesPreset(*option)) {
            text += pattern +
                    "compopt -o filenames\n            mapfile -t COMPREPLY < <(compgen -W \"$(" +
                    function + "_presets)\" -- \"$cur\"; compgen -f -- \"$cur\")\n" +
                    "            return\n            ;;\n";
        } else {
            // No words: bash completes files, unless it is a number.
            text += pattern +
                    (isNumber(*option) ? "compopt +o default\n            return\n" : "return\n") +
                    "            ;;\n";
        }
    }
    return text;
}

}  // namespace

std::string bashCompletion(const CLI::App& app, const std::string& program) {
    const std::string function = functionName(program);
    const Apps commands = commandsOf(app);
    std::vector<std::string> names;
    for (const CLI::App* command : commands) names.push_back(command->get_name());

    std::string values = bashValues(app, "", function);
    std::string flags = "        '') flags=" + quoted(joined(namesOf(flagsOf(app)), " ")) + " ;;\n";
    for (const CLI::App* command : commands) {
        values += bashValues(*command, command->get_name(), function);
        flags += "        " + command->get_name() +
                 ") flags=" + quoted(joined(namesOf(flagsOf(*command)), " ")) + " ;;\n";
    }

    std::string text = "# Completion of " + program + "(1) for bash. Generated by the program.\n\n";
    text += presetsFunction(function, "${HAGEN_CONFIG_PATH//:/ } \"$(dirname \"$(command -v " +
                                          program + ")\")/../share/hagen/config\"");
    text += function +
            "() {\n    local cur=${COMP_WORDS[COMP_CWORD]} prev=${COMP_WORDS[COMP_CWORD-1]}\n"
            "    local command='' flags='' word\n    COMPREPLY=()\n";
    if (!commands.empty()) {
        text +=
            "    for word in \"${COMP_WORDS[@]:1:COMP_CWORD-1}\"; do\n        case $word in\n"
            "            " +
            joined(names, "|") +
            ")\n                command=$word\n                break\n"
            "                ;;\n        esac\n    done\n";
    }
    text += "    case $command,$prev in\n" + values + "    esac\n    case $command in\n" + flags +
            "    esac\n    if [[ $cur == -* ]]; then\n"
            "        mapfile -t COMPREPLY < <(compgen -W \"$flags\" -- \"$cur\")\n";
    if (!commands.empty()) {
        text += "    elif [ -z \"$command\" ]; then\n        mapfile -t COMPREPLY < <(compgen -W " +
                quoted(joined(names, " ")) + " -- \"$cur\")\n";
    }
    return text + "    fi\n}\ncomplete -o default -F " + function + " " + program + "\n";
}

namespace {

std::string zshMessage(std::string text) {
    for (const char* special : {"\\", "[", "]", ":", "`", "$", "\""}) {
        text = replaced(text, special, std::string("\\") + special);
    }
    return replaced(text, "'", "'\\''");
}

/// The arguments of _arguments for the flags of a command, one per line.
std::string zshArguments(const CLI::App& app, const std::string& function,
                         const std::string& indent) {
    std::string text;
    for (const CLI::Option* option : flagsOf(app)) {
        std::string action;
        if (takesValue(*option)) {
            const std::vector<std::string> choices = completedChoicesOf(*option);
            action = ":" + zshMessage(valueOf(*option)) + ":";
            if (!choices.empty()) {
                action += "(" + joined(choices, " ") + ")";
            } else if (takesPreset(*option)) {
                action += function + "_settings";
            } else if (!isNumber(*option)) {
                action += "_files";
            }
        }
        const std::vector<std::string> names = namesOf(*option);
        for (const std::string& name : names) {
            const bool is_long = name.rfind("--", 0) == 0;
            const std::string exclusive =
                isRepeatable(*option) ? "*" : "(" + joined(names, " ") + ")";
            text += indent + "'" + exclusive + name + (is_long && takesValue(*option) ? "=" : "") +
                    "[" + zshMessage(option->get_description()) + "]" + action + "' \\\n";
        }
    }
    return text;
}

}  // namespace

std::string zshCompletion(const CLI::App& app, const std::string& program) {
    const std::string function = functionName(program);
    const Apps commands = commandsOf(app);
    std::string text = "#compdef " + program + "\n# Generated by the program.\n\n";
    text += presetsFunction(function, "${(s.:.)HAGEN_CONFIG_PATH} ${commands[" + program +
                                          "]:h}/../share/hagen/config");
    text += function + "_settings() {\n    local -a presets=(${(f)\"$(" + function +
            "_presets)\"})\n    _alternative \"presets:preset:compadd -a presets\" "
            "'files:file:_files'\n}\n\n";
    if (commands.empty()) {
        return text + "_arguments -s \\\n" + zshArguments(app, function, "    ") +
               "    '*:file:_files'\n";
    }
    text += "local curcontext=$curcontext state line\n_arguments -C -s \\\n" +
            zshArguments(app, function, "    ") + "    '1:command:->command' \\\n" +
            "    '*::argument:->arguments'\ncase $state in\n    command)\n"
            "        local -a names=(\n";
    for (const CLI::App* command : commands) {
        text += "            '" + command->get_name() + ":" +
                zshMessage(command->get_description()) + "'\n";
    }
    text +=
        "        )\n        _describe command names\n        ;;\n    arguments)\n"
        "        case $words[1] in\n";
    for (const CLI::App* command : commands) {
        text += "            " + command->get_name() + ")\n                _arguments -s \\\n" +
                zshArguments(*command, function, "                    ") +
                "                    '*:file:_files'\n                ;;\n";
    }
    return text + "        esac\n        ;;\nesac\n";
}

}  // namespace hagen::command_line
