#include "base/command_line/ProgressLine.h"
#include "base/command_line/Terminal.h"

#include <unistd.h>

#include <cmath>
#include <iomanip>
#include <iostream>
#include <sstream>
#include <utility>

namespace hagen::base {
namespace {

std::string durationText(double seconds) {
    std::ostringstream text;
    if (seconds < 90) {
        text << std::lround(seconds) << " s";
    } else if (seconds < 5400) {
        text << std::lround(seconds / 60) << " min";
    } else {
        text << std::fixed << std::setprecision(1) << seconds / 3600 << " h";
    }
    return text.str();
}

}  // namespace

ProgressLine::ProgressLine(std::string thing)
    : thing_(std::move(thing)), is_on_terminal_(isatty(STDERR_FILENO) == 1) {}

ProgressLine::~ProgressLine() {
    if (is_shown_ && is_on_terminal_) std::cerr << clearLine << std::flush;
}

bool ProgressLine::isDue(std::size_t done, std::size_t all) const {
    if (!is_shown_) return true;
    if (is_on_terminal_) return done != last_;
    return 10 * done / all != 10 * last_ / all ||
           Clock::now() - last_time_ > std::chrono::minutes(1);
}

void ProgressLine::show(std::size_t done, std::size_t all) {
    if (all == 0 || !isDue(done, all)) return;
    is_shown_ = true;
    last_ = done;
    last_time_ = Clock::now();
    if (done >= all && is_on_terminal_) {  // clears the line for later output
        std::cerr << clearLine << std::flush;
        return;
    }
    std::ostringstream line;
    line << thing_ << " " << done << " of " << all;
    if (done > 0 && done < all) {
        const std::chrono::duration<double> taken = last_time_ - start_;
        const double left = static_cast<double>(all - done) / static_cast<double>(done);
        line << ", about " << durationText(taken.count() * left) << " left";
    }
    if (is_on_terminal_) {
        std::cerr << clearLine << line.str() << std::flush;
    } else {
        std::cerr << line.str() << std::endl;
    }
}

}  // namespace hagen::base
