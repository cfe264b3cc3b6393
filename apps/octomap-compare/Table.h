#pragma once
#include <hagen/trials/Statistics.h>
#include <string>
#include <vector>

namespace hagen {

/// A table of a report. The first column is text, the others are figures.
struct Table {
    std::vector<std::string> header;
    std::vector<std::vector<std::string>> rows;
};

std::string htmlOf(const Table& table);
std::string markdownOf(const Table& table);

/// Escapes what has a meaning in HTML.
std::string htmlText(const std::string& text);

/// With these decimals, "-" for NaN; '.' whatever the locale.
std::string fixed(double value, int decimals);
/// "3.2 to 4.1".
std::string fixed(const Bounds& bounds, int decimals);
/// A share as "97.5".
std::string percent(double share);
/// "97.5 (94.3 to 98.9)" by Wilson; "-" of no trials.
std::string percentOf(int successes, int trials);
/// The same with the number of runs: "96.0 (92.3 to 98.0; 200)".
std::string percentOfRuns(int successes, int runs);
/// "<0.001", "0.023".
std::string pText(double p);

}  // namespace hagen
