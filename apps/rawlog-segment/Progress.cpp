#include "Progress.h"
#include <hagen/command_line/Terminal.h>

#include <unistd.h>

#include <cstdio>
#include <iostream>

namespace {

using Seconds = std::chrono::duration<double>;

constexpr std::size_t kMostRemarks = 10;  // one per scan would hide everything else
constexpr Seconds kBetweenLines{0.1}, kBeforeRate{1.0};

std::string clockOf(double seconds) {
    const auto whole = static_cast<long>(seconds + 0.5);
    char text[32];
    if (whole >= 3600) {
        std::snprintf(text, sizeof text, "%ld:%02ld:%02ld", whole / 3600, whole / 60 % 60,
                      whole % 60);
    } else {
        std::snprintf(text, sizeof text, "%ld:%02ld", whole / 60, whole % 60);
    }
    return text;
}

}  // namespace

Progress::Progress(std::string input, bool quiet)
    : input_(std::move(input)),
      is_quiet_(quiet),
      is_on_terminal_(!quiet && isatty(STDERR_FILENO) != 0),
      start_(std::chrono::steady_clock::now()),
      shown_(start_) {}

hagen::logs::ConversionListener Progress::listener() {
    hagen::logs::ConversionListener listener;
    listener.unreadable = [this](const std::string& entry, const std::string& why) {
        tell(entry, "kept, but not segmented: " + why);
    };
    listener.remark = [this](const std::string& entry, const std::string& what) {
        remark(entry, what);
    };
    if (is_on_terminal_) {
        listener.progress = [this](const hagen::logs::ConversionReport& report) { show(report); };
    }
    return listener;
}

void Progress::tell(const std::string& entry, const std::string& what) {
    if (is_on_terminal_) std::cerr << hagen::command_line::clearLine;
    std::cerr << input_ << ": " << entry << ": " << what << "\n";
}

void Progress::remark(const std::string& entry, const std::string& remark) {
    if (is_quiet_ || remarks_[remark]++ > 0) return;
    if (remarks_.size() > kMostRemarks) {
        ++untold_;
    } else {
        tell(entry, remark);
    }
}

void Progress::show(const hagen::logs::ConversionReport& report) {
    const auto now = std::chrono::steady_clock::now();
    if (now - shown_ < kBetweenLines) return;
    shown_ = now;
    const double elapsed_s = Seconds(now - start_).count();
    std::cerr << hagen::command_line::clearLine << report.entries << " entries, " << report.scans
              << " scans";
    if (elapsed_s > kBeforeRate.count() && report.fraction > 0) {
        char rate[64];
        std::snprintf(rate, sizeof rate, ", %.0f scans/s, %.0f %%, ",
                      static_cast<double>(report.scans) / elapsed_s, 100 * report.fraction);
        std::cerr << rate << clockOf(elapsed_s * (1 - report.fraction) / report.fraction)
                  << " left";
    }
    std::cerr << std::flush;
}

void Progress::finish() {
    if (is_on_terminal_) std::cerr << hagen::command_line::clearLine;
    for (const auto& [remark, times] : remarks_) {
        if (times < 2) continue;
        std::cerr << input_ << ": the same for " << times - 1 << " more: " << remark << "\n";
    }
    if (untold_ > 0) std::cerr << input_ << ": and " << untold_ << " more warnings\n";
}
