#pragma once
#include <string>
#include <vector>

namespace hagen::pages {

/// A table of a report. The first column is text, the others are figures.
struct Table {
    std::vector<std::string> header;
    std::vector<std::vector<std::string>> rows;
};

std::string htmlOf(const Table& table);
std::string markdownOf(const Table& table);

/// Escapes what has a meaning in HTML.
std::string htmlText(const std::string& text);

/// With this many decimals, '.' whatever the locale; "-" for what is not finite.
std::string figure(double value, int decimals);

}  // namespace hagen::pages
