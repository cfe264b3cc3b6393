// Runs each fuzz target on its seeds, their prefixes and some mutations. HAGEN_FUZZ_SECONDS: time
// for mutations per target (default: a few hundred mutations); HAGEN_FUZZ_SEED: random seed
// (default: 1).
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <iostream>
#include <random>

#include "fuzz/Target.h"

namespace hagen::fuzz {
namespace {

using Clock = std::chrono::steady_clock;

unsigned numberFrom(const char* variable, unsigned otherwise) {
    const char* const text = std::getenv(variable);
    return text == nullptr ? otherwise : static_cast<unsigned>(std::strtoul(text, nullptr, 10));
}

/// A seed with some changed bytes, and possibly a removed or repeated part.
std::string mutated(std::string bytes, std::mt19937& random) {
    if (bytes.empty()) return bytes;
    const auto place = [&] { return random() % bytes.size(); };
    for (unsigned changes = 1 + random() % 4; changes > 0; --changes) {
        constexpr unsigned char kEdges[] = {0, 1, 0x7f, 0x80, 0xff};
        bytes[place()] = static_cast<char>(random() % 2 == 0 ? kEdges[random() % 5] : random());
    }
    if (random() % 4 == 0) bytes.erase(place(), random() % 16);
    if (random() % 4 == 0 && !bytes.empty()) {
        const std::string part = bytes.substr(place(), random() % 32);
        bytes.insert(place(), part);
    }
    return bytes;
}

class Seeds : public testing::TestWithParam<std::string> {
 protected:
    const Target& target() const {
        const auto& all = targets();
        return *std::find_if(all.begin(), all.end(),
                             [](const Target& each) { return each.name == GetParam(); });
    }
    /// Reports a finding as a failure and prints the bytes.
    void run(const std::string& input) const {
        try {
            target().run(input);
        } catch (const std::exception& e) {
            ADD_FAILURE() << e.what() << " by " << testing::PrintToString(input);
        }
    }
};

TEST_P(Seeds, AreReadOrRejected) {
    const auto seeds = target().seeds();
    ASSERT_FALSE(seeds.empty());
    run("");
    for (const std::string& seed : seeds) {
        EXPECT_LE(seed.size(), target().longest);
        run(seed);
        for (std::size_t part = 1; part < 8; ++part) run(seed.substr(0, seed.size() * part / 8));
    }
}

TEST_P(Seeds, MutationsAreReadOrRejected) {
    if (!target().is_bounded) GTEST_SKIP() << "may exhaust memory: " << target().name;
    std::mt19937 random(numberFrom("HAGEN_FUZZ_SEED", 1));
    const auto seeds = target().seeds();
    const std::size_t min = seeds.size() * (1 + 200 / seeds.size());
    const auto end = Clock::now() + std::chrono::seconds(numberFrom("HAGEN_FUZZ_SECONDS", 0));
    std::size_t inputs = 0;
    for (; inputs < min || Clock::now() < end; ++inputs) {
        if (HasFailure()) break;
        run(mutated(seeds[inputs % seeds.size()], random));
    }
    std::cout << target().name << ": " << inputs << " mutated inputs\n";
}

std::vector<std::string> names() {
    std::vector<std::string> names;
    for (const Target& target : targets()) names.push_back(target.name);
    return names;
}

INSTANTIATE_TEST_SUITE_P(Fuzz, Seeds, testing::ValuesIn(names()),
                         [](const auto& each) { return each.param; });

TEST(FuzzTargets, AreAllRegistered) {
    EXPECT_EQ(targets().size(), std::size_t{HAGEN_FUZZ_TARGETS});
}

}  // namespace
}  // namespace hagen::fuzz
