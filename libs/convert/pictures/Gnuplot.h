#pragma once
#include <filesystem>
#include <string>
#include <vector>

namespace hagen::convert {

/// Quotes any text as a gnuplot string without commands; line breaks become blanks. Draw it with
/// `noenhanced`; otherwise `_` and `^` shift the text that follows.
std::string gnuplotString(const std::string& text);

/// Runs `script` with gnuplot in `folder` and checks that every picture of `pictures` was created:
/// a complete PNG, or a complete SVG if the name ends in .svg. Existing pictures of these names are
/// replaced. Uses no shell and ignores the user's gnuplot settings. Throws std::runtime_error if
/// gnuplot is missing (the message says what to install), if a picture cannot be written (the
/// message names it), or if gnuplot rejects the script (the message quotes gnuplot).
void runGnuplot(const std::string& script, const std::filesystem::path& folder,
                const std::vector<std::string>& pictures);

}  // namespace hagen::convert
