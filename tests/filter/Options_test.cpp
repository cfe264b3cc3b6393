#include <gtest/gtest.h>
#include <hagen/filter/Options.h>
#include "filter/OptionKeys.h"

#include <stdexcept>
#include <string>

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
        try {
            checkOptions(options, 64);
            ADD_FAILURE() << key.name;
        } catch (const std::invalid_argument& e) {
            EXPECT_EQ(std::string(e.what()).rfind(key.name, 0), 0u) << e.what();
        }
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
