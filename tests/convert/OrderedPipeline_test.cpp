// The order of pipeline steps for any number of threads.
#include <gtest/gtest.h>

#include <random>
#include <stdexcept>

#include "convert/OrderedPipeline.h"

namespace hagen::convert {
namespace {

struct Numbered {
    int number = 0, squared = 0;
};

struct Seen {
    std::vector<int> accounted, written;
    int read = 0;
};

/// Squares 0 ... items - 1 with random delays.
PipelineSteps<Numbered> squares(int items, Seen& seen) {
    PipelineSteps<Numbered> steps;
    steps.read = [&seen, items](Numbered& item) {
        item.number = seen.read;
        return seen.read++ < items;
    };
    steps.work = [](Numbered& item) {
        std::mt19937 random(static_cast<unsigned>(item.number));
        std::this_thread::sleep_for(std::chrono::microseconds(random() % 200));
        item.squared = item.number * item.number;
    };
    steps.account = [&seen](Numbered& item) { seen.accounted.push_back(item.squared); };
    steps.pack = steps.work;
    steps.write = [&seen](Numbered& item) { seen.written.push_back(item.squared); };
    return steps;
}

TEST(OrderedPipeline, KeepsOrder) {
    std::vector<int> expected;
    for (int i = 0; i < 200; ++i) expected.push_back(i * i);
    for (const std::size_t threads : {1, 2, 3, 8, 300}) {
        Seen seen;
        EXPECT_EQ(runPipeline(squares(200, seen), threads).threads, threads);
        EXPECT_EQ(seen.accounted, expected) << threads;
        EXPECT_EQ(seen.written, expected) << threads;
    }
    Seen seen;
    runPipeline(squares(0, seen), 4);
    EXPECT_TRUE(seen.written.empty());
}

/// The first exception ends the pipeline; the items written before form an ordered prefix.
TEST(OrderedPipeline, StopsAtException) {
    for (const std::size_t threads : {1, 2, 8}) {
        for (int step = 0; step < 5; ++step) {
            Seen seen;
            PipelineSteps<Numbered> steps = squares(100, seen);
            const auto failing = [](auto whole) {
                return [whole](Numbered& item) {
                    if (item.number == 40) throw std::runtime_error("forty");
                    return whole(item);
                };
            };
            if (step == 0) {
                steps.read = [whole = steps.read](Numbered& item) {
                    const bool is_read = whole(item);
                    if (item.number == 40) throw std::runtime_error("forty");
                    return is_read;
                };
            }
            if (step == 1) steps.work = failing(steps.work);
            if (step == 2) steps.account = failing(steps.account);
            if (step == 3) steps.pack = failing(steps.pack);
            if (step == 4) steps.write = failing(steps.write);
            EXPECT_TRUE(runPipeline(steps, threads).why) << step;
            EXPECT_LE(seen.written.size(), 40u) << threads << " " << step;
            for (std::size_t i = 0; i < seen.written.size(); ++i) {
                EXPECT_EQ(seen.written[i], static_cast<int>(i * i));
            }
        }
    }
}

}  // namespace
}  // namespace hagen::convert
