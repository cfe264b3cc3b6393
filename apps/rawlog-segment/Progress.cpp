#include "Progress.h"
#include "base/NumberText.h"
#include "base/command_line/Terminal.h"

#include <unistd.h>

#include <cstdio>
#include <iostream>

namespace {

using Seconds = std::chrono::duration<double>;

constexpr std::size_t kMaxRemarks = 10;  // per kind, so that frequent remarks do not hide others
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

/// The text of a remark without numbers and names, which similar remarks have in common.
std::string kindOf(const std::string& remark) {
    std::string kind;
    bool is_quoted = false;
    for (const char c : remark) {
        if (c == '\'') is_quoted = !is_quoted;
        if (is_quoted || (c >= '0' && c <= '9')) continue;
        kind += c;
    }
    return kind;
}

}  // namespace

Progress::Progress(std::string input, bool quiet)
    : input_(std::move(input)),
      is_quiet_(quiet),
      is_on_terminal_(!quiet && isatty(STDERR_FILENO) != 0),
      start_(std::chrono::steady_clock::now()),
      shown_(start_) {}

hagen::convert::ConversionListener Progress::listener() {
    hagen::convert::ConversionListener listener;
    listener.unreadable = [this](const std::string& entry, const std::string& why) {
        print(entry, "kept, but not segmented: " + why);
    };
    listener.remark = [this](const std::string& entry, const std::string& what) {
        remark(entry, what);
    };
    if (is_on_terminal_) {
        listener.progress = [this](const hagen::convert::ConversionReport& report) {
            show(report);
        };
    }
    return listener;
}

void Progress::print(const std::string& entry, const std::string& what) {
    if (is_on_terminal_) std::cerr << hagen::base::clearLine;
    std::cerr << hagen::base::oneLine(input_ + ": " + entry + ": " + what) << "\n";
}

void Progress::remark(const std::string& entry, const std::string& remark) {
    if (is_quiet_) return;
    Remark& known = remarks_[remark];
    if (known.times++ > 0) {
        if (!known.is_printed) ++kinds_[kindOf(remark)].suppressed;
        return;
    }
    Kind& kind = kinds_[kindOf(remark)];
    known.is_printed = kind.printed < kMaxRemarks;
    if (known.is_printed) {
        ++kind.printed;
        print(entry, remark);
    } else {
        ++kind.suppressed;
        kind.last = remark;
    }
}

void Progress::show(const hagen::convert::ConversionReport& report) {
    const auto now = std::chrono::steady_clock::now();
    if (now - shown_ < kBetweenLines) return;
    shown_ = now;
    const double elapsed_s = Seconds(now - start_).count();
    std::cerr << hagen::base::clearLine << hagen::base::counted(report.entries, "entry", "entries")
              << ", " << hagen::base::counted(report.scans, "scan");
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
    if (is_on_terminal_) std::cerr << hagen::base::clearLine;
    for (const auto& [text, remark] : remarks_) {
        if (remark.times < 2 || !remark.is_printed) continue;
        std::cerr << input_ << ": the same for " << remark.times - 1
                  << " more: " << hagen::base::oneLine(text) << "\n";
    }
    for (const auto& [text, kind] : kinds_) {
        if (kind.suppressed == 0) continue;
        std::cerr << input_ << ": and " << kind.suppressed
                  << " more like this: " << hagen::base::oneLine(kind.last) << "\n";
    }
}
