#pragma once
#include <hagen/convert/Conversion.h>
#include <chrono>
#include <map>
#include <string>

/// Reports a conversion on standard error: warnings and, on a terminal, a progress line.
class Progress {
 public:
    Progress(std::string input, bool quiet);

    /// Returns the listener of a conversion, which keeps a reference to this object.
    hagen::convert::ConversionListener listener();

    /// Clears the line and prints the pending warnings. A repeated warning is printed once and then
    /// counted.
    void finish();

 private:
    void print(const std::string& entry, const std::string& what);
    void remark(const std::string& entry, const std::string& remark);
    void show(const hagen::convert::ConversionReport& report);

    std::string input_;
    bool is_quiet_, is_on_terminal_;
    struct Remark {
        std::size_t times = 0;
        bool is_printed = false;
    };
    struct Kind {
        std::size_t printed = 0, suppressed = 0;
        std::string last;  ///< last suppressed remark
    };
    std::map<std::string, Remark> remarks_;  ///< counts by text
    std::map<std::string, Kind> kinds_;      ///< counts by text without numbers and names
    std::chrono::steady_clock::time_point start_, shown_;
};
