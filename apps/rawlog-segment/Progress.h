#pragma once
#include <hagen/logs/Conversion.h>
#include <chrono>
#include <map>
#include <string>

/// What a conversion tells on standard error: remarks, and on a terminal a line of progress.
class Progress {
 public:
    Progress(std::string input, bool quiet);

    /// The listener of a conversion; holds a reference to this object.
    hagen::logs::ConversionListener listener();

    /// Clears the line, and tells what was held back: the same remark of many scans is printed
    /// where it first comes up, and counted from then on.
    void finish();

 private:
    void tell(const std::string& entry, const std::string& what);
    void remark(const std::string& entry, const std::string& remark);
    void show(const hagen::logs::ConversionReport& report);

    std::string input_;
    bool is_quiet_, is_on_terminal_;
    std::map<std::string, std::size_t> remarks_;  ///< and how often they came
    std::size_t untold_ = 0;
    std::chrono::steady_clock::time_point start_, shown_;
};
