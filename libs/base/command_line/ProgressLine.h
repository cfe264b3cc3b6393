#pragma once
#include <chrono>
#include <cstddef>
#include <string>

namespace hagen::base {

/// Reports the progress of a long command on standard error. On a terminal, updates one line and
/// erases it at the end. Otherwise, as in a cluster job's log, prints a line at the start, after
/// every 10 % of the work and at least every minute.
class ProgressLine {
 public:
    /// `thing`: the unit of progress, such as "run".
    explicit ProgressLine(std::string thing);
    ~ProgressLine();
    ProgressLine(const ProgressLine&) = delete;
    ProgressLine& operator=(const ProgressLine&) = delete;

    void show(std::size_t done, std::size_t all);

 private:
    bool isDue(std::size_t done, std::size_t all) const;

    using Clock = std::chrono::steady_clock;
    std::string thing_;
    bool is_on_terminal_, is_shown_ = false;
    std::size_t last_ = 0;
    Clock::time_point start_ = Clock::now(), last_time_ = start_;
};

}  // namespace hagen::base
