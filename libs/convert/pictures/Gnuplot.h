#pragma once
#include <filesystem>
#include <string>
#include <vector>

namespace hagen::convert {

/// Quotes text as a literal gnuplot string; line breaks become blanks. Draw it with `noenhanced`;
/// otherwise `_` and `^` mean subscript and superscript.
std::string gnuplotString(const std::string& text);

/// Runs `script` with gnuplot in `folder` and checks that every picture of `pictures` is a complete
/// PNG, or SVG if the name ends in .svg. Replaces existing pictures. Uses no shell and ignores the
/// user's gnuplot settings. Throws std::runtime_error if gnuplot is missing (the message says which
/// package to install), if a picture cannot be written (the message names it), or if gnuplot
/// rejects the script (the message quotes gnuplot).
void runGnuplot(const std::string& script, const std::filesystem::path& folder,
                const std::vector<std::string>& pictures);

}  // namespace hagen::convert
