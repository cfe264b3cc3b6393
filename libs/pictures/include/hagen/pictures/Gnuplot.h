#pragma once
#include <filesystem>
#include <string>
#include <vector>

namespace hagen::pictures {

/// Any text as a string of gnuplot's, in which nothing is a command; line breaks become blanks.
/// Draw it with `noenhanced`, else `_` and `^` shift what follows.
std::string gnuplotString(const std::string& text);

/// Has gnuplot run `script` in `folder`, and checks that it left there each of the `pictures`, a
/// whole PNG, or a whole SVG where the name ends in .svg. Pictures of these names that lie there
/// are replaced. No shell is in between, and none of the user's own gnuplot settings are read.
/// Throws std::runtime_error: what to install where there is no gnuplot; the picture's name where
/// one cannot be written; gnuplot's own words where it refuses the script.
void runGnuplot(const std::string& script, const std::filesystem::path& folder,
                const std::vector<std::string>& pictures);

}  // namespace hagen::pictures
