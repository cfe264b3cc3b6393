#include <hagen/mrpt/PointTable.h>

#include <algorithm>
#include <cstring>
#include <set>
#include <stdexcept>

#include "base/Text.h"
#include "mrpt/NumberTypes.h"

namespace hagen::observations {
namespace {

static_assert(__BYTE_ORDER__ == __ORDER_LITTLE_ENDIAN__, "tables need byte swapping");

template <class Number>
Number numberAt(const std::uint8_t* at, bool is_swapped) {
    std::array<std::uint8_t, sizeof(Number)> bytes{};
    std::copy_n(at, sizeof(Number), bytes.begin());
    if (is_swapped) std::reverse(bytes.begin(), bytes.end());
    Number number;
    std::memcpy(&number, bytes.data(), sizeof number);
    return number;
}

}  // namespace

std::size_t bytesOf(NumberType type) {
    return withType(type, [](auto number) { return sizeof number; });
}

const char* nameOf(NumberType type) {
    constexpr std::array<const char*, 10> kNames{"int8",   "uint8", "int16",  "uint16",  "int32",
                                                 "uint32", "int64", "uint64", "float32", "float64"};
    return kNames.at(static_cast<std::size_t>(type));
}

void check(const PointTable& table) {
    std::set<std::string> names;
    std::size_t numbers = 0;
    for (const PointField& field : table.fields) {
        if (field.name.empty()) throw std::runtime_error("a field has no name");
        const std::string title = "the field '" + field.name + "'";
        if (!names.insert(field.name).second) throw std::runtime_error(title + " occurs twice");
        if (field.count == 0) throw std::runtime_error(title + " has a count of 0");
        // If there are no points, the data size does not limit the counts in a header.
        if (field.count > kMaxNumbersPerPoint - numbers) {
            throw std::runtime_error(title + " (" + std::to_string(field.count) + " times " +
                                     nameOf(field.type) + ") exceeds the limit of " +
                                     std::to_string(kMaxNumbersPerPoint) +
                                     " numbers per point; is the header damaged?");
        }
        numbers += field.count;
        const std::size_t size = bytesOf(field.type);
        const std::size_t room = table.bytes_per_point;
        // Products of untrusted numbers could overflow.
        if (field.offset > room || field.count > (room - field.offset) / size) {
            throw std::runtime_error(title + " (" + std::to_string(field.count) + " times " +
                                     nameOf(field.type) + " from byte " +
                                     std::to_string(field.offset) + ") does not fit into the " +
                                     std::to_string(room) + " bytes of a point");
        }
    }
    if (table.points == 0) return;
    if (table.bytes_per_point == 0) throw std::runtime_error("the size of a point is 0 bytes");
    if (table.points > table.bytes.size() / table.bytes_per_point) {
        throw std::runtime_error(std::to_string(table.points) + " points of " +
                                 std::to_string(table.bytes_per_point) +
                                 " bytes expected, but the table has only " +
                                 std::to_string(table.bytes.size()) + " bytes");
    }
}

const PointField* findExactly(const PointTable& table, const std::string& name) {
    const auto field = std::find_if(table.fields.begin(), table.fields.end(),
                                    [&](const PointField& one) { return one.name == name; });
    return field == table.fields.end() ? nullptr : &*field;
}

const PointField* findField(const PointTable& table, const std::vector<std::string>& names) {
    for (const std::string& name : names) {
        if (const PointField* const field = findExactly(table, name)) return field;
        for (const std::string& sought :
             {base::lowerCase(name), "scalar_" + base::lowerCase(name)}) {
            for (const PointField& field : table.fields) {
                if (base::lowerCase(field.name) == sought) return &field;
            }
        }
    }
    return nullptr;
}

std::vector<double> columnOf(const PointTable& table, const PointField& field,
                             std::size_t element) {
    std::vector<double> numbers(table.points);
    if (numbers.empty()) return numbers;
    withType(field.type, [&](auto type) {
        using Number = decltype(type);
        const std::uint8_t* at = table.bytes.data() + field.offset + element * sizeof(Number);
        for (double& number : numbers) {
            number = static_cast<double>(numberAt<Number>(at, table.is_big_endian));
            at += table.bytes_per_point;
        }
    });
    return numbers;
}

std::vector<double> columnOf(const PointTable& table, const PointField& field,
                             const std::vector<std::uint32_t>& points) {
    const std::vector<double> all = columnOf(table, field);
    std::vector<double> numbers;
    numbers.reserve(points.size());
    for (const std::uint32_t i : points) numbers.push_back(all[i]);
    return numbers;
}

void addColumn(const std::string& name, NumberType type, const std::vector<double>& numbers,
               PointTable& table) {
    const std::size_t size = bytesOf(type), before = table.bytes_per_point;
    std::vector<std::uint8_t> wider(table.points * (before + size));
    withType(type, [&](auto number) {
        for (std::size_t i = 0; i < table.points; ++i) {
            std::uint8_t* const point = wider.data() + i * (before + size);
            std::copy_n(table.bytes.data() + i * before, before, point);
            number = static_cast<decltype(number)>(numbers[i]);
            std::memcpy(point + before, &number, size);
        }
    });
    table.fields.push_back({name, type, before, 1});
    table.bytes_per_point = before + size;
    table.bytes = std::move(wider);
}

PointTable pointsOf(const PointTable& table, const std::vector<std::uint32_t>& points) {
    PointTable some;
    some.fields = table.fields;
    some.points = points.size();
    some.bytes_per_point = table.bytes_per_point;
    some.is_big_endian = table.is_big_endian;
    some.bytes.reserve(points.size() * table.bytes_per_point);
    for (const std::uint32_t i : points) {
        const auto point =
            table.bytes.begin() + static_cast<std::ptrdiff_t>(i * table.bytes_per_point);
        some.bytes.insert(some.bytes.end(), point,
                          point + static_cast<std::ptrdiff_t>(table.bytes_per_point));
    }
    return some;
}

PointTable inNativeOrder(PointTable table) {
    if (!table.is_big_endian) return table;
    for (const PointField& field : table.fields) {
        const auto size = static_cast<std::ptrdiff_t>(bytesOf(field.type));
        for (std::size_t i = 0; i < table.points; ++i) {
            auto at = table.bytes.begin() +
                      static_cast<std::ptrdiff_t>(i * table.bytes_per_point + field.offset);
            for (std::size_t element = 0; element < field.count; ++element, at += size) {
                std::reverse(at, at + size);
            }
        }
    }
    table.is_big_endian = false;
    return table;
}

std::string namesOf(const PointTable& table) {
    std::string names;
    for (const PointField& field : table.fields) names += (names.empty() ? "" : ", ") + field.name;
    return names;
}

}  // namespace hagen::observations
