#include <gmock/gmock.h>
#include <hagen/mrpt/PointTable.h>

#include <limits>

#include "support/Program.h"

namespace hagen::observations {
namespace {

using testing::ElementsAre;

/// Two points of 8 bytes with a manual layout: a uint16 at byte 1 and a float32 at byte 4.
PointTable twoPoints() {
    PointTable table;
    table.fields = {{"Ring", NumberType::UInt16, 1, 1}, {"x", NumberType::Float32, 4, 1}};
    table.points = 2;
    table.bytes_per_point = 8;
    table.bytes = {0xff, 0x02, 0x01, 0xff, 0x00, 0x00, 0x80, 0x3f,   // 258, 1.0
                   0xff, 0x03, 0x00, 0xff, 0x00, 0x00, 0x20, 0xc1};  // 3, -10.0
    return table;
}

TEST(PointTable, ReadsColumnsAtAnyByte) {
    const PointTable table = twoPoints();
    EXPECT_NO_THROW(check(table));
    EXPECT_THAT(columnOf(table, table.fields[0]), ElementsAre(258, 3));
    EXPECT_THAT(columnOf(table, table.fields[1]), ElementsAre(1, -10));
}

TEST(PointTable, AcceptsZeroPoints) {
    PointTable table = twoPoints();
    table.points = 0;
    table.bytes = {};
    EXPECT_NO_THROW(check(table));
    EXPECT_THAT(columnOf(table, table.fields[1]), ElementsAre());  // checked by sanitizers
}

TEST(PointTable, SwapsBigEndianNumbers) {
    PointTable table;
    table.fields = {{"x", NumberType::Float32, 0, 2}, {"n", NumberType::Int16, 8, 1}};
    table.points = 1;
    table.bytes_per_point = 10;
    table.is_big_endian = true;
    table.bytes = {0x3f, 0x80, 0, 0, 0xc1, 0x20, 0, 0, 0xff, 0xfe};
    const PointTable native = inNativeOrder(table);
    for (const PointTable& each : {table, native}) {
        EXPECT_THAT(columnOf(each, each.fields[0], 0), ElementsAre(1));
        EXPECT_THAT(columnOf(each, each.fields[0], 1), ElementsAre(-10));
        EXPECT_THAT(columnOf(each, each.fields[1]), ElementsAre(-2));
    }
    EXPECT_NE(native.bytes, table.bytes);
}

TEST(PointTable, KeepsExtremesOfEachType) {
    PointTable table;
    table.points = 2;
    const auto add = [&](const char* name, NumberType type, auto number) {
        using Limits = std::numeric_limits<decltype(number)>;
        const auto lowest = static_cast<double>(Limits::lowest());
        addColumn(name, type, {lowest, 1.0}, table);
        EXPECT_THAT(columnOf(table, table.fields.back()), ElementsAre(lowest, 1.0)) << name;
        EXPECT_EQ(bytesOf(type), sizeof number) << name;
    };
    add("int8", NumberType::Int8, std::int8_t());
    add("uint8", NumberType::UInt8, std::uint8_t());
    add("int16", NumberType::Int16, std::int16_t());
    add("uint16", NumberType::UInt16, std::uint16_t());
    add("int32", NumberType::Int32, std::int32_t());
    add("uint32", NumberType::UInt32, std::uint32_t());
    add("int64", NumberType::Int64, std::int64_t());
    add("uint64", NumberType::UInt64, std::uint64_t());
    add("float32", NumberType::Float32, float());
    add("float64", NumberType::Float64, double());
    EXPECT_NO_THROW(check(table));
    for (const PointField& field : table.fields) EXPECT_EQ(field.name, nameOf(field.type));
    EXPECT_THAT(columnOf(table, table.fields[1]), ElementsAre(0, 1));  // other fields unchanged
}

TEST(PointTable, FindsFieldsCaseInsensitively) {
    const PointTable table = twoPoints();
    EXPECT_EQ(findField(table, {"ring"}), &table.fields[0]);
    EXPECT_EQ(findField(table, {"line", "X", "ring"}), &table.fields[1]);
    EXPECT_EQ(findField(table, {"y"}), nullptr);
    EXPECT_EQ(namesOf(table), "Ring, x");
    PointTable both = table;
    both.fields[1].name = "ring";
    EXPECT_EQ(findField(both, {"ring"}), &both.fields[1]);
    EXPECT_EQ(findField(both, {"RING"}), &both.fields[0]);
    EXPECT_EQ(findExactly(both, "RING"), nullptr);
}

TEST(PointTable, RejectsInvalidTables) {
    const auto refuses = [](const auto& change) {
        PointTable table = twoPoints();
        change(table);
        EXPECT_THROW(check(table), std::runtime_error);
    };
    constexpr std::size_t kHuge = std::numeric_limits<std::size_t>::max();
    refuses([](PointTable& table) { table.points = 3; });
    refuses([=](PointTable& table) { table.points = kHuge / 4; });
    refuses([](PointTable& table) { table.bytes.pop_back(); });
    refuses([](PointTable& table) { table.fields[1].offset = 5; });
    refuses([=](PointTable& table) { table.fields[1].offset = kHuge; });
    refuses([](PointTable& table) { table.fields[1].count = 2; });
    refuses([=](PointTable& table) { table.fields[1].count = kHuge / 4 + 2; });
    refuses([](PointTable& table) { table.fields[1].count = 0; });
    refuses([](PointTable& table) { table.fields[1].name = ""; });
    refuses([](PointTable& table) { table.fields[1].name = "Ring"; });
    refuses([](PointTable& table) {
        table.fields.clear();
        table.bytes_per_point = 0;
    });
}

TEST(PointTable, LimitsNumbersPerPoint) {
    PointTable table;
    table.fields = {{"x", NumberType::Float32, 0, 1},
                    {"a", NumberType::UInt8, 4, kMaxNumbersPerPoint - 2},
                    {"b", NumberType::UInt8, 4 + kMaxNumbersPerPoint, 1}};
    table.bytes_per_point = std::numeric_limits<std::size_t>::max();
    EXPECT_NO_THROW(check(table));
    for (const std::size_t count : {std::size_t{2}, table.bytes_per_point / 2}) {
        table.fields[2].count = count;
        EXPECT_THAT(test::messageOf([&] { check(table); }),
                    testing::AllOf(testing::HasSubstr("'b' (" + std::to_string(count)),
                                   testing::HasSubstr("65536 numbers per point")));
    }
}

}  // namespace
}  // namespace hagen::observations
