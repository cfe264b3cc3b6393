#pragma once
#include <chrono>
#include <memory>
#include <string>

namespace hagen::base {

/// Prints from a thread of its own, for work that must not wait until somebody reads: a terminal
/// that is stopped (Ctrl-S), or a pipe that is full. What does not fit is left out, and counted.
class BackgroundPrinter {
 public:
    static constexpr std::size_t kMostWaiting = 1000;  ///< texts
    /// The last: in place of what is on the terminal's line.
    enum class To { Output, Errors, ErrorsInPlace };

    /// Throws std::system_error if no thread can be started.
    BackgroundPrinter();
    ~BackgroundPrinter();  ///< finish(), unless it was called
    BackgroundPrinter(const BackgroundPrinter&) = delete;
    BackgroundPrinter& operator=(const BackgroundPrinter&) = delete;

    /// Of any thread; never waits.
    void print(To to, std::string text);
    /// The same, unless something waits to be printed: for what a later text replaces.
    void printIfIdle(To to, std::string text);
    /// Waits until all is printed, but not longer than this; returns whether it is. Later texts are
    /// left out.
    bool finish(std::chrono::milliseconds longest = std::chrono::seconds(2));
    /// After finish(): whether all texts of To::Output were printed.
    bool isOutputPrinted() const;

 private:
    struct Waiting;
    std::shared_ptr<Waiting> waiting_;  ///< the thread may outlive this
};

}  // namespace hagen::base
