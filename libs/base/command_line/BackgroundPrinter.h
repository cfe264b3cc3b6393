#pragma once
#include <chrono>
#include <memory>
#include <string>

namespace hagen::base {

/// Prints on a separate thread, so that a stopped terminal (Ctrl-S) or a full pipe does not block
/// the caller. Messages beyond the queue's size are dropped and counted.
class BackgroundPrinter {
 public:
    static constexpr std::size_t kMaxWaiting = 1000;  ///< max. number of queued texts
    /// ErrorsInPlace replaces the current line of the terminal.
    enum class To { Output, Errors, ErrorsInPlace };

    /// Throws std::system_error if no thread can be started.
    BackgroundPrinter();
    ~BackgroundPrinter();  ///< finish(), unless it was called
    BackgroundPrinter(const BackgroundPrinter&) = delete;
    BackgroundPrinter& operator=(const BackgroundPrinter&) = delete;

    /// Queues a text. Thread-safe; never blocks.
    void print(To to, std::string text);
    /// Like print(), but drops the text if another one is queued. For periodic status lines.
    void printIfIdle(To to, std::string text);
    /// Waits until all texts are printed or the timeout expires; returns false if texts are left.
    /// Texts passed afterwards are dropped.
    bool finish(std::chrono::milliseconds longest = std::chrono::seconds(2));
    /// After finish(): true if all texts of To::Output were printed.
    bool isOutputPrinted() const;

 private:
    struct Waiting;
    std::shared_ptr<Waiting> waiting_;  ///< shared, because the thread may outlive this object
};

}  // namespace hagen::base
