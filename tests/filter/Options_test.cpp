#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <hagen/filter/Options.h>
#include "filter/OptionKeys.h"

#include <stdexcept>
#include <string>

#include "support/Program.h"

namespace hagen {
namespace {

TEST(Options, RejectsMoreComponentsThanWindow) {
    Options options;
    options.principal_components = options.window_size + 1;
    EXPECT_THROW(checkOptions(options, 16), std::invalid_argument);
}

TEST(Options, AblationsDifferFromDefaults) {
    for (const OptionKey& key : optionKeys()) {
        for (const Ablation& off : key.ablations) {
            EXPECT_NE(off.value, textOf(key, Options())) << key.name;
        }
    }
}

TEST(Options, ChecksEveryRange) {
    for (const OptionKey& key : optionKeys()) {
        if (std::holds_alternative<bool Options::*>(key.field)) continue;  // all values are valid
        Options options;
        std::visit(
            [&](auto field) {
                using Value = std::decay_t<decltype(options.*field)>;
                options.*field = static_cast<Value>(key.min - 1.0);
            },
            key.field);
        EXPECT_THAT(test::messageOf<std::invalid_argument>([&] { checkOptions(options, 64); }),
                    testing::StartsWith(key.name));
    }
}

TEST(Options, AcceptsRangeLimits) {
    for (const OptionKey& key : optionKeys()) {
        for (const double end : {key.min, key.max}) {
            Options options;
            options.window_size = 64;          // so that the maximum number of components fits
            options.principal_components = 1;  // so that the minimum window fits
            std::visit(
                [&](auto field) {
                    using Value = std::decay_t<decltype(options.*field)>;
                    options.*field = static_cast<Value>(end);
                },
                key.field);
            EXPECT_NO_THROW(checkOptions(options, 128)) << key.name << " " << end;
        }
    }
}

TEST(Options, RejectsWindowLongerThanColumn) {
    Options options;
    options.window_size = 15;
    EXPECT_NO_THROW(checkOptions(options, 16));
    options.window_size = 16;
    EXPECT_THROW(checkOptions(options, 16), std::invalid_argument);
}

}  // namespace
}  // namespace hagen
