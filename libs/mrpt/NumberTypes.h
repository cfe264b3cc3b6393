#pragma once
#include <hagen/mrpt/PointTable.h>

#include <array>
#include <cstdint>

namespace hagen::observations {

/// Calls `use` with a value of the corresponding C++ type and returns the result.
template <class Use>
auto withType(NumberType type, const Use& use) {
    switch (type) {
        case NumberType::Int8:  // NOLINT(bugprone-branch-clone): the types differ
            return use(std::int8_t());
        case NumberType::UInt8:
            return use(std::uint8_t());
        case NumberType::Int16:
            return use(std::int16_t());
        case NumberType::UInt16:
            return use(std::uint16_t());
        case NumberType::Int32:
            return use(std::int32_t());
        case NumberType::UInt32:
            return use(std::uint32_t());
        case NumberType::Int64:
            return use(std::int64_t());
        case NumberType::UInt64:
            return use(std::uint64_t());
        case NumberType::Float32:
            return use(float());
        case NumberType::Float64:
            break;
    }
    return use(double());
}

/// The types of sensor_msgs/PointField; datatype 1 is the first.
constexpr std::array<NumberType, 8> kPointFieldTypes{
    NumberType::Int8,  NumberType::UInt8,  NumberType::Int16,   NumberType::UInt16,
    NumberType::Int32, NumberType::UInt32, NumberType::Float32, NumberType::Float64};

}  // namespace hagen::observations
