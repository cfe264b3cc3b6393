// Tables as Markdown or CSV, and number formatting.
#pragma once
#include <hagen/evaluation/DroneScores.h>
#include <map>
#include <string>
#include <vector>
#include "evaluation/Bootstrap.h"

namespace hagen {

class Table {
 public:
    explicit Table(std::vector<std::string> heads) : lines_{std::move(heads)} {}
    /// Adds a row, which must have as many cells as the head.
    void add(std::vector<std::string> cells) { lines_.push_back(std::move(cells)); }
    /// Returns the table with aligned columns, followed by a blank line.
    std::string text() const;
    /// Returns the table as CSV, without Markdown's bold and code marks.
    std::string csv() const;

 private:
    std::vector<std::vector<std::string>> lines_;
};

/// CSV tables by file name.
using CsvTables = std::map<std::string, std::string>;

/// A number such as "0.958"; a dash if undefined.
std::string cell(double value, int digits = 3);
/// Such as "0.951 to 0.964".
std::string cell(const evaluation::Interval& interval);
/// Such as "0.958 / 0.977"; values that equal `best` when rounded are bold.
std::string pairCell(double roi, double rou, double best_roi, double best_rou);
std::string pairCell(double roi, double rou);
/// A number such as "0.958", bold if above `other` when rounded.
std::string boldAbove(double value, double other);

/// Such as "12 of 3456 (0.35 %)"; a dash without items.
std::string missedCell(const evaluation::Missed& missed);

}  // namespace hagen
