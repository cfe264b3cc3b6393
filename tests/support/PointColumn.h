#pragma once
#include <gtest/gtest.h>
#include <hagen/mrpt/PointTable.h>

namespace hagen::test {

/// The values of a field, which must exist.
inline std::vector<double> column(const observations::PointTable& table, const char* name) {
    const auto* const field = findField(table, {name});
    EXPECT_NE(field, nullptr) << name;
    return field == nullptr ? std::vector<double>() : columnOf(table, *field);
}

}  // namespace hagen::test
