#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <hagen/trials/DealRuns.h>

namespace hagen::trials {
namespace {

using testing::ElementsAre;
using Row = hagen::trials::Run;  // a test has a Run() of its own

std::vector<CourseFlights> someFlights(std::uint64_t courses, int setups) {
    std::vector<TrialSetup> all;
    for (int i = 0; i < setups; ++i) {
        all.emplace_back();
        all.back().speed_m_s = 1 + i;
    }
    std::vector<CourseFlights> flights;
    for (std::uint64_t seed = 0; seed < courses; ++seed) flights.push_back({"gap", seed, all});
    return flights;
}

bool none(const Row&) { return false; }

TEST(DealRuns, AllRunsAreDealtOnceInTheirOrder) {
    const auto flights = someFlights(100, 3);
    std::vector<std::string> all;
    for (const CourseFlights& course : flights) {
        for (const TrialSetup& setup : course.setups) {
            Row run{};
            run.scenario = course.scenario;
            run.seed = course.seed;
            run.setup = setup;
            all.push_back(keyOf(run));
        }
    }
    for (const std::size_t jobs : {1u, 2u, 7u, 500u}) {
        std::vector<std::string> dealt;
        for (const RunShare& share : dealRuns(flights, jobs, none)) {
            EXPECT_EQ(share.size() % 3, 0u);  // whole courses
            dealt.insert(dealt.end(), share.begin(), share.end());
        }
        EXPECT_EQ(dealt, all) << jobs;
    }
}

TEST(DealRuns, SharesShrinkToOneCourseSoThatJobsEndTogether) {
    const std::vector<RunShare> shares = dealRuns(someFlights(100, 1), 2, none);
    EXPECT_EQ(shares.front().size(), 12u);  // an eighth of all
    for (std::size_t i = 1; i < shares.size(); ++i) {
        EXPECT_LE(shares[i].size(), shares[i - 1].size());
    }
    for (std::size_t i = shares.size() - 8; i < shares.size(); ++i) {
        EXPECT_EQ(shares[i].size(), 1u);
    }
    EXPECT_LT(shares.size(), 35u);  // processes to start
}

TEST(DealRuns, NoShareIsLong) {
    for (const RunShare& share : dealRuns(someFlights(10000, 30), 1, none)) {
        EXPECT_LE(share.size(), 200u);
    }
    const std::vector<RunShare> parts = dealRuns(someFlights(1, 450), 2, none);  // of a course
    ASSERT_EQ(parts.size(), 3u);
    EXPECT_EQ(parts[0].size(), 200u);
    EXPECT_EQ(parts[2].size(), 50u);
}

TEST(DealRuns, FlownRunsAreLeftOut) {
    const auto is_flown = [](const Row& run) { return run.seed == 0 || run.setup.speed_m_s < 2; };
    const auto shares = dealRuns(someFlights(2, 2), 4, is_flown);
    ASSERT_EQ(shares.size(), 1u);
    EXPECT_THAT(shares[0],
                ElementsAre("gap,1,W-RoI,astar,2,primitives,none,1,optimistic,dusty,unbiased"));
    EXPECT_TRUE(dealRuns(someFlights(2, 2), 4, [](const Row&) { return true; }).empty());
}

}  // namespace
}  // namespace hagen::trials
