#include "base/command_line/BackgroundPrinter.h"
#include "base/NumberText.h"
#include "base/command_line/Terminal.h"

#include <condition_variable>
#include <deque>
#include <iostream>
#include <mutex>
#include <thread>

namespace hagen::base {

struct BackgroundPrinter::Waiting {
    std::mutex mutex;
    std::condition_variable changed;
    std::deque<std::pair<To, std::string>> texts;
    std::size_t dropped = 0;
    bool is_printing = false, is_over = false;
    bool is_printing_output = false, is_output_dropped = false;

    bool isIdle() const { return texts.empty() && !is_printing; }

    void add(To to, std::string&& text) {
        if (is_over || texts.size() >= kMaxWaiting) {
            ++dropped;
            is_output_dropped = is_output_dropped || to == To::Output;
            return;
        }
        if (dropped > 0) {
            const std::size_t count = std::exchange(dropped, 0);
            texts.emplace_back(To::Errors, counted(count, "message") +
                                               " dropped: the terminal or pipe was blocked\n");
        }
        texts.emplace_back(to, std::move(text));
        changed.notify_all();
    }

    /// Runs on the printing thread.
    void run() {
        std::unique_lock lock(mutex);
        for (;;) {
            changed.wait(lock, [&] { return is_over || !texts.empty(); });
            if (texts.empty()) return;
            const auto [to, text] = std::move(texts.front());
            texts.pop_front();
            is_printing = true;
            is_printing_output = to == To::Output;
            lock.unlock();
            // Writing may block.
            if (to == To::ErrorsInPlace) std::cerr << clearLine;
            (to == To::Output ? std::cout : std::cerr) << text << std::flush;
            lock.lock();
            is_printing = is_printing_output = false;
            changed.notify_all();
        }
    }
};

BackgroundPrinter::BackgroundPrinter() : waiting_(std::make_shared<Waiting>()) {
    std::thread([waiting = waiting_] { waiting->run(); }).detach();
}

BackgroundPrinter::~BackgroundPrinter() {
    bool is_over = false;
    {
        const std::lock_guard lock(waiting_->mutex);
        is_over = waiting_->is_over;
    }
    if (!is_over) finish();
}

void BackgroundPrinter::print(To to, std::string text) {
    const std::lock_guard lock(waiting_->mutex);
    waiting_->add(to, std::move(text));
}

void BackgroundPrinter::printIfIdle(To to, std::string text) {
    const std::lock_guard lock(waiting_->mutex);
    if (waiting_->isIdle()) waiting_->add(to, std::move(text));
}

bool BackgroundPrinter::finish(std::chrono::milliseconds longest) {
    std::unique_lock lock(waiting_->mutex);
    const bool is_printed =
        waiting_->changed.wait_for(lock, longest, [&] { return waiting_->isIdle(); });
    waiting_->is_over = true;
    waiting_->is_output_dropped = waiting_->is_output_dropped || waiting_->is_printing_output;
    for (const auto& [to, text] : waiting_->texts) {
        if (to == To::Output) waiting_->is_output_dropped = true;
    }
    waiting_->texts.clear();
    waiting_->changed.notify_all();
    return is_printed;
}

bool BackgroundPrinter::isOutputPrinted() const {
    const std::lock_guard lock(waiting_->mutex);
    return !waiting_->is_output_dropped;
}

}  // namespace hagen::base
