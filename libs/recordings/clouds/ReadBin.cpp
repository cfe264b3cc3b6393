#include <algorithm>
#include <cmath>
#include <iterator>
#include <set>

#include "recordings/clouds/Readers.h"

namespace hagen::recordings {
namespace {

using observations::NumberType;

bool isPacked(const Bytes& bytes) {
    constexpr std::uint8_t kGzip[] = {0x1f, 0x8b}, kZstd[] = {0x28, 0xb5, 0x2f, 0xfd};
    const auto starts = [&](const auto& magic) {
        return bytes.size() >= std::size(magic) &&
               std::equal(std::begin(magic), std::end(magic), bytes.begin());
    };
    return starts(kGzip) || starts(kZstd);
}

/// Whether these are points of a LiDAR, if each has so many float32: x, y, z, intensity, ....
bool arePoints(const Bytes& bytes, std::size_t numbers_per_point) {
    constexpr float kFarthest_m = 1000.0f, kMostIntensity = 65535.0f;
    const std::size_t numbers =
        bytes.size() / (sizeof(float) * numbers_per_point) * numbers_per_point;
    bool is_all_zero = true;
    for (std::size_t i = 0; i < numbers; ++i) {
        const auto number = numberAt<float>(bytes, sizeof(float) * i);
        const float most = i % numbers_per_point < 3 ? kFarthest_m : kMostIntensity;
        if (std::isfinite(number) && std::abs(number) > most) return false;
        if (std::fpclassify(number) == FP_SUBNORMAL) return false;  // of text and integers
        is_all_zero = is_all_zero && number == 0.0f;
    }
    return !is_all_zero;
}

/// What the fifth numbers of points say, if each has five.
struct FifthNumbers {
    bool are_whole = true;  ///< and 0 to 255, as the numbers of beams
    bool are_coordinates_whole = true;
    std::size_t returns = 0;  ///< points that are not at zero
    std::set<float> of_returns;
};

FifthNumbers fifthsOf(const Bytes& bytes) {
    constexpr std::size_t kNumbers = 5;
    constexpr float kHighestRing = 255.0f;
    FifthNumbers fifths;
    const std::size_t points = bytes.size() / (sizeof(float) * kNumbers);
    for (std::size_t i = 0; i < points; ++i) {
        const auto number = [&](std::size_t k) {
            return numberAt<float>(bytes, sizeof(float) * (kNumbers * i + k));
        };
        const float ring = number(4);
        if (!(ring >= 0 && ring <= kHighestRing) || ring != std::floor(ring)) {
            fifths.are_whole = false;
            return fifths;
        }
        bool is_return = false;
        for (std::size_t k = 0; k < 3; ++k) {
            if (number(k) != std::floor(number(k))) fifths.are_coordinates_whole = false;
            is_return = is_return || number(k) != 0;
        }
        if (!is_return) continue;
        ++fifths.returns;
        fifths.of_returns.insert(ring);
    }
    return fifths;
}

/// Among four numbers per point, every fifth is an x, y, z or intensity by turns, or 0 where there
/// is no return: with so many returns, not all are whole. Those of a grid are.
bool areRings(const FifthNumbers& fifths) {
    constexpr std::size_t kFewestReturns = 16;
    return fifths.are_whole && !fifths.are_coordinates_whole && fifths.returns >= kFewestReturns;
}

}  // namespace

Bytes tellingBytes(const Bytes& bytes) {
    constexpr std::size_t kBothPoints = 80;  // points of 16 and of 20 bytes
    const auto first =
        std::find_if(bytes.begin(), bytes.end(), [](auto byte) { return byte != 0; });
    auto from = static_cast<std::size_t>(first - bytes.begin());
    from = from < kStart || first == bytes.end() ? 0 : from / kBothPoints * kBothPoints;
    const auto start = bytes.begin() + static_cast<std::ptrdiff_t>(from);
    return {start, start + static_cast<std::ptrdiff_t>(std::min(bytes.size() - from, kStart))};
}

bool isAllZero(const Bytes& bytes) {
    return std::all_of(bytes.begin(), bytes.end(), [](auto byte) { return byte == 0; });
}

BinPoint binPointOf(const Bytes& start) {
    if (isPacked(start)) return BinPoint::None;
    const bool may_be_four = arePoints(start, 4);
    if (arePoints(start, 5)) {
        const FifthNumbers fifths = fifthsOf(start);
        if (areRings(fifths) && fifths.of_returns.size() > 1) return BinPoint::Five;
        // One beam only, or few returns: the rest decides.
        if (fifths.are_whole && may_be_four) return BinPoint::FourOrFive;
        if (fifths.are_whole && start.size() >= kStart) return BinPoint::FiveOrNone;
    }
    return may_be_four ? BinPoint::Four : BinPoint::None;
}

BinPoint binPointOf(BinPoint of_start, const Bytes& all) {
    if (of_start != BinPoint::FourOrFive && of_start != BinPoint::FiveOrNone) return of_start;
    if (areRings(fifthsOf(all))) return BinPoint::Five;
    return of_start == BinPoint::FourOrFive ? BinPoint::Four : BinPoint::None;
}

CloudFile readBin(const std::filesystem::path& file, Bytes bytes) {
    const Bytes start = tellingBytes(bytes);
    const BinPoint of_start = binPointOf(start), point = binPointOf(of_start, bytes);
    // One that is cut may have no whole point.
    const bool may_be_cut = of_start == BinPoint::None && bytes.size() % 16 != 0;
    if (point == BinPoint::None && !may_be_cut && !isAllZero(start)) {
        throw BrokenRecording(file.string() + ": " + whyNoCloud(start));
    }
    CloudFile cloud;
    cloud.table.fields = {{"x", NumberType::Float32, 0, 1},
                          {"y", NumberType::Float32, 4, 1},
                          {"z", NumberType::Float32, 8, 1},
                          {"intensity", NumberType::Float32, 12, 1}};
    if (point == BinPoint::Five) {
        cloud.table.fields.push_back({"ring", NumberType::Float32, 16, 1});
    }
    const std::size_t bytes_per_point = sizeof(float) * cloud.table.fields.size();
    if (bytes.size() % bytes_per_point != 0) {
        throw BrokenRecording(file.string() + ": " + std::to_string(bytes.size()) +
                              " bytes are not a multiple of " + std::to_string(bytes_per_point) +
                              "-byte points; is it truncated?");
    }
    checkNumber(file, bytes.size() / bytes_per_point);
    cloud.table.bytes_per_point = bytes_per_point;
    cloud.table.points = bytes.size() / bytes_per_point;
    cloud.table.bytes = std::move(bytes);
    return cloud;
}

}  // namespace hagen::recordings
