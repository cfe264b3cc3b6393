// Manual pages and completions of shells, compared with --help.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <filesystem>
#include <regex>
#include <set>
#include <sstream>

#include "support/Program.h"

namespace hagen {
namespace {

namespace fs = std::filesystem;
using Words = std::set<std::string>;

const fs::path kShare = HAGEN_BUILT_SHARE;

struct Program {
    std::string path;
    std::vector<std::string> commands;
    std::string name() const { return fs::path(path).filename().string(); }
};
/// In the names of tests, which would have the bytes of a Program otherwise.
void PrintTo(const Program& program, std::ostream* out) { *out << program.name(); }

bool isInstalled(const std::string& program) {
    return test::run("/bin/sh", {"-c", "command -v " + program}).exit_code == 0;
}

Words matches(const std::string& text, const std::string& pattern) {
    const std::regex regex(pattern);
    Words words;
    for (std::sregex_iterator i(text.begin(), text.end(), regex), end; i != end; ++i) {
        words.insert((*i)[1]);
    }
    return words;
}

/// The flags at the beginning of lines of --help.
Words flagsOfHelp(const Program& program, const std::string& command) {
    std::vector<std::string> arguments{"--help"};
    if (!command.empty()) arguments.insert(arguments.begin(), command);
    const std::string help = test::run(program.path, arguments).out;
    Words flags = matches(help, "\n  (-[A-Za-z])[, ]");
    flags.merge(matches(help, "\n  (?:-[A-Za-z],)?(--[-a-z0-9]+)"));
    EXPECT_THAT(flags, testing::Contains("--help")) << help;
    return flags;
}

/// The part of a manual page from one heading to the next: .SH, or for a command its .SS.
std::string sectionOf(const std::string& page, const std::string& command) {
    const std::string head = command.empty() ? ".SH OPTIONS\n" : ".SS " + command + "\n";
    const std::size_t begin = page.find(head);
    EXPECT_NE(begin, std::string::npos) << head;
    if (begin == std::string::npos) return "";
    const std::size_t end = command.empty()
                                ? page.find("\n.SH ", begin)
                                : std::min(page.find("\n.SS ", begin), page.find("\n.SH ", begin));
    return page.substr(begin, end - begin);
}

/// What bash offers for the last of these words.
Words bashOffers(const Program& program, const std::vector<std::string>& words) {
    std::string line;
    for (const std::string& word : words) line += " \"" + word + "\"";
    const fs::path script = kShare / "bash-completion/completions" / program.name();
    const auto outcome =
        test::run("/bin/bash",
                  {"-c",
                   "compopt() { :; }; source \"$0\"; PATH=$(dirname \"$1\"):$PATH; COMP_WORDS=(x" +
                       line + "); COMP_CWORD=" + std::to_string(words.size()) +
                       "; $(complete -p \"$2\" | sed \"s/.*-F \\([^ ]*\\).*/\\1/\"); "
                       "printf \"%s\\n\" \"${COMPREPLY[@]}\"",
                   script.string(), program.path, program.name()});
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_EQ(outcome.err, "");
    Words offers;
    std::istringstream lines(outcome.out);
    for (std::string offer; std::getline(lines, offer);) {
        if (!offer.empty()) offers.insert(offer);
    }
    return offers;
}

class Manual : public testing::TestWithParam<Program> {
 protected:
    /// The program itself and its commands.
    static std::vector<std::string> commands() {
        std::vector<std::string> all = GetParam().commands;
        all.insert(all.begin(), "");
        return all;
    }
    static std::string page() {
        const std::string text = test::readFile(kShare / "man/man1" / (GetParam().name() + ".1"));
        EXPECT_NE(text, "");
        return std::regex_replace(text, std::regex("\\\\-"), "-");
    }
};

TEST_P(Manual, PageHasTheFlagsOfHelp) {
    const std::string text = page();
    for (const std::string& command : commands()) {
        const Words flags =
            matches(sectionOf(text, command), "\\\\fB(--?[A-Za-z][-a-z0-9]*)\\\\fR");
        EXPECT_EQ(flags, flagsOfHelp(GetParam(), command)) << command;
    }
}

TEST_P(Manual, PageHasItsSections) {
    const std::string text = page();
    for (const char* section :
         {"NAME", "SYNOPSIS", "DESCRIPTION", "OPTIONS", "EXIT STATUS", "EXAMPLES", "SEE ALSO"}) {
        const bool has_space = std::string(section).find(' ') != std::string::npos;
        const std::string quote = has_space ? "\"" : "";
        EXPECT_THAT(text, testing::HasSubstr("\n.SH " + quote + section + quote + "\n"));
    }
    EXPECT_THAT(text, testing::HasSubstr("\n.SH NAME\n" + GetParam().name() + " - "));
    const std::string version = test::run(GetParam().path, {"--version"}).out;
    EXPECT_THAT(text, testing::HasSubstr(
                          "\"Hagen " + version.substr(version.find(' ') + 1,
                                                      version.find('\n') - version.find(' ') - 1)));
}

TEST_P(Manual, PageRendersWithoutWarnings) {
    const std::string file = (kShare / "man/man1" / (GetParam().name() + ".1")).string();
    if (!isInstalled("mandoc") && !isInstalled("groff")) GTEST_SKIP() << "no mandoc, no groff";
    if (isInstalled("mandoc")) {
        const auto outcome = test::run("mandoc", {"-T", "lint", "-W", "warning", file});
        EXPECT_EQ(outcome.out + outcome.err, "");
    }
    if (isInstalled("groff")) {
        const auto outcome = test::run("groff", {"-man", "-ww", "-z", "-Tascii", file});
        EXPECT_EQ(outcome.err, "");
    }
}

TEST_P(Manual, BashOffersTheFlagsOfHelp) {
    for (const std::string& command : commands()) {
        std::vector<std::string> words{"-"};
        if (!command.empty()) words.insert(words.begin(), command);
        EXPECT_EQ(bashOffers(GetParam(), words), flagsOfHelp(GetParam(), command)) << command;
    }
}

TEST_P(Manual, BashOffersTheCommands) {
    const Words commands(GetParam().commands.begin(), GetParam().commands.end());
    EXPECT_EQ(bashOffers(GetParam(), {""}), commands);
}

TEST_P(Manual, ZshOffersTheFlagsOfHelp) {
    const std::string script =
        test::readFile(kShare / "zsh/site-functions" / ("_" + GetParam().name()));
    EXPECT_EQ(script.rfind("#compdef " + GetParam().name() + "\n", 0), 0u);
    for (const std::string& command : commands()) {
        const std::size_t begin =
            command.empty() ? 0 : script.find("            " + command + ")\n");
        ASSERT_NE(begin, std::string::npos) << command;
        const std::size_t end = script.find(command.empty() ? "'*:" : ";;", begin);
        const Words flags = matches(script.substr(begin, end - begin),
                                    "\n *'(?:\\*|\\([^)]*\\))(--?[A-Za-z][-a-z0-9]*)=?\\[");
        EXPECT_EQ(flags, flagsOfHelp(GetParam(), command)) << command;
    }
    if (isInstalled("zsh")) {
        const auto outcome = test::run(
            "zsh", {"-n", (kShare / "zsh/site-functions" / ("_" + GetParam().name())).string()});
        EXPECT_EQ(outcome.err, "");
    }
}

INSTANTIATE_TEST_SUITE_P(
    OfPrograms, Manual,
    testing::Values(Program{HAGEN_LIVE_SEGMENT, {}}, Program{HAGEN_RAWLOG_SEGMENT, {}},
                    Program{HAGEN_RAWLOG_SIMULATE, {}}, Program{HAGEN_SEGMENTATION_EVALUATE, {}},
                    Program{HAGEN_OCTOMAP_COMPARE,
                            {"closedloop", "calibrate", "distances", "openloop", "replay"}}),
    [](const auto& of) { return std::regex_replace(of.param.name(), std::regex("-"), "_"); });

TEST(Completion, OffersTheWordsOfAChoice) {
    const Program segment{HAGEN_RAWLOG_SEGMENT, {}};
    EXPECT_EQ(bashOffers(segment, {"--cloud", ""}), (Words{"simple", "xyzi", "generic"}));
    EXPECT_EQ(bashOffers(segment, {"--octomap-content", "roi"}), (Words{"roi", "roi+rays"}));
    EXPECT_EQ(bashOffers(segment, {"--from", ""}), Words{});
    const Program simulate{HAGEN_RAWLOG_SIMULATE, {}};
    EXPECT_EQ(bashOffers(simulate, {"--scenario", "forest"}),
              (Words{"forest-0.02", "forest-0.05", "forest-0.10"}));
    const Program live{HAGEN_LIVE_SEGMENT, {}};
    EXPECT_EQ(bashOffers(live, {"--model", ""}),  // not "Puck Hi-Res", which has a space
              (Words{"VLP-16", "HDL-32E", "VLP-32C", "HDL-64E", "Mid-360"}));
    const Program compare{HAGEN_OCTOMAP_COMPARE, {}};
    EXPECT_EQ(bashOffers(compare, {"closedloop", "--unknown", "b"}), Words{"brake-known"});
}

TEST(Completion, OffersPresets) {
    const Program segment{HAGEN_RAWLOG_SEGMENT, {}};
    EXPECT_EQ(bashOffers(segment, {"-c", "hdl"}), (Words{"hdl32e", "hdl64e"}));
    EXPECT_EQ(bashOffers(segment, {"--config", "vlp"}), Words{"vlp16"});
}

}  // namespace
}  // namespace hagen
