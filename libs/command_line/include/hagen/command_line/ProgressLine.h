#pragma once
#include <chrono>
#include <cstddef>
#include <string>

namespace hagen::command_line {

/// Says on stderr how far a long command is. On a terminal that is one line, over and over; where
/// it is none, such as a log of a cluster's job, a line at first, and then every tenth and minute.
class ProgressLine {
 public:
    /// `thing` is what is counted: "run".
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

}  // namespace hagen::command_line
