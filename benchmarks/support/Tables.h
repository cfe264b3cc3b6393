// Tables in Markdown, and figures as their cells.
#pragma once
#include <hagen/evaluation/Bootstrap.h>
#include <string>
#include <vector>

namespace hagen {

class Table {
 public:
    explicit Table(std::vector<std::string> heads) : lines_{std::move(heads)} {}
    /// A line; `cells` as many as heads.
    void add(std::vector<std::string> cells) { lines_.push_back(std::move(cells)); }
    /// Aligned, so that it can be read as it is too, with a blank line behind.
    std::string text() const;

 private:
    std::vector<std::vector<std::string>> lines_;
};

/// "0.958", and a dash for what is not defined.
std::string cell(double value, int digits = 3);
/// "0.951 to 0.964".
std::string cell(const evaluation::Interval& interval);
/// "0.958 / 0.977"; those that reach `best` as it is printed are bold.
std::string pairCell(double roi, double rou, double best_roi, double best_rou);
std::string pairCell(double roi, double rou);
/// "0.958"; bold where it is above `other` as it is printed.
std::string boldAbove(double value, double other);

}  // namespace hagen
