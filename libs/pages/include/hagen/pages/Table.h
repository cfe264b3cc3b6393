#pragma once
#include <string>
#include <vector>

namespace hagen::pages {

/// A table of a report. The first column has text, the others figures.
struct Table {
    std::vector<std::string> header;
    std::vector<std::vector<std::string>> rows;
};

std::string htmlOf(const Table& table);
std::string markdownOf(const Table& table);

/// Escapes HTML's special characters.
std::string htmlText(const std::string& text);

/// Formats a number with this many decimals, with '.' in any locale; "-" if it is not finite.
std::string figure(double value, int decimals);

}  // namespace hagen::pages
