#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <optional>
#include <set>
#include <sstream>
#include <stdexcept>

#include "recordings/clouds/Readers.h"

namespace hagen::recordings {
namespace {

using observations::NumberType;

bool isPacked(const Bytes& bytes) {
    return otherKindOf(bytes).find("-compressed") != std::string::npos;
}

/// True for plausible LiDAR points with this number of float32 values: x, y, z, intensity, ...
bool arePoints(const Bytes& bytes, std::size_t numbers_per_point) {
    constexpr float kFarthest_m = 1000.0f, kMaxIntensity = 65535.0f;
    const std::size_t numbers =
        bytes.size() / (sizeof(float) * numbers_per_point) * numbers_per_point;
    bool is_all_zero = true;
    for (std::size_t i = 0; i < numbers; ++i) {
        const auto number = numberAt<float>(bytes, sizeof(float) * i);
        const float max = i % numbers_per_point < 3 ? kFarthest_m : kMaxIntensity;
        if (std::isfinite(number) && std::abs(number) > max) return false;
        if (std::fpclassify(number) == FP_SUBNORMAL) return false;  // typical of text and integers
        is_all_zero = is_all_zero && number == 0.0f;
    }
    return !is_all_zero;
}

/// Properties of points, assuming five numbers per point.
struct FifthNumbers {
    bool are_whole = true;  ///< integers from 0 to 255, like ring numbers
    bool are_coordinates_whole = true;
    std::size_t returns = 0;  ///< points that are not at the origin
    std::set<float> of_returns;
};

FifthNumbers fifthsOf(const Bytes& bytes) {
    constexpr std::size_t kNumbers = 5;
    constexpr float kMaxRing = 255.0f;
    FifthNumbers fifths;
    const std::size_t points = bytes.size() / (sizeof(float) * kNumbers);
    for (std::size_t i = 0; i < points; ++i) {
        const auto number = [&](std::size_t k) {
            return numberAt<float>(bytes, sizeof(float) * (kNumbers * i + k));
        };
        const float ring = number(4);
        if (!(ring >= 0 && ring <= kMaxRing) || ring != std::floor(ring)) {
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

/// True if the fifth numbers look like rings. If points had four numbers, every fifth number would
/// be an x, y, z or intensity in turn, or 0 without a return, and rarely an integer. (Points on a
/// grid are an exception.)
bool areRings(const FifthNumbers& fifths) {
    constexpr std::size_t kMinReturns = 16;
    return fifths.are_whole && !fifths.are_coordinates_whole && fifths.returns >= kMinReturns;
}

/// Returns the first bytes or, if these are zero (rows of sky), those from the first return on.
Bytes startOfReturns(const Bytes& bytes) {
    constexpr std::size_t kBothPoints = 80;  // a multiple of 16 and of 20 bytes
    const auto first =
        std::find_if(bytes.begin(), bytes.end(), [](auto byte) { return byte != 0; });
    auto from = static_cast<std::size_t>(first - bytes.begin());
    from = from < kStart || first == bytes.end() ? 0 : from / kBothPoints * kBothPoints;
    const auto start = bytes.begin() + static_cast<std::ptrdiff_t>(from);
    return {start, start + static_cast<std::ptrdiff_t>(std::min(bytes.size() - from, kStart))};
}

/// The median angle between the azimuths of consecutive points with this number of float32 values;
/// nullopt if there are too few returns. It is small if the points are in scan order.
std::optional<double> azimuthStep(const Bytes& bytes, std::size_t numbers_per_point) {
    constexpr std::size_t kMinPairs = 16, kMaxPairs = 2000;
    constexpr float kFarthest_m = 1000.0f;
    const std::size_t size = sizeof(float) * numbers_per_point, points = bytes.size() / size;
    std::vector<double> steps;
    for (std::size_t i = 0; i + 1 < points; i += 1 + points / kMaxPairs) {
        const auto number = [&](std::size_t point, std::size_t k) {
            const auto value = numberAt<float>(bytes, point * size + sizeof(float) * k);
            return std::abs(value) <= kFarthest_m ? value : std::nanf("");
        };
        const double x = number(i, 0), y = number(i, 1);
        const double next_x = number(i + 1, 0), next_y = number(i + 1, 1);
        const double step = std::atan2(std::abs(x * next_y - y * next_x), x * next_x + y * next_y);
        const bool are_returns = (x != 0 || y != 0) && (next_x != 0 || next_y != 0);
        if (are_returns && !std::isnan(step)) steps.push_back(step);
    }
    if (steps.size() < kMinPairs) return std::nullopt;
    const auto middle = steps.begin() + static_cast<std::ptrdiff_t>(steps.size() / 2);
    std::nth_element(steps.begin(), middle, steps.end());
    return *middle;
}

}  // namespace

BinFields binFieldsOf(const std::string& text) {
    static const std::map<std::string, std::string> kShort{
        {"i", "intensity"}, {"r", "ring"}, {"t", "time"}, {"_", "-"}};
    BinFields fields;
    std::istringstream words(text + ",");
    for (std::string word; std::getline(words, word, ',');) {
        const auto known = kShort.find(word);
        fields.push_back(known == kShort.end() ? word : known->second);
    }
    for (const std::string& field : fields) {
        if (field.empty()) throw std::runtime_error("a field has no name");
        if (field != "-" && std::count(fields.begin(), fields.end(), field) > 1) {
            throw std::runtime_error("the field '" + field + "' occurs twice");
        }
    }
    for (const char* const needed : {"x", "y", "z"}) {
        if (std::count(fields.begin(), fields.end(), needed) == 1) continue;
        throw std::runtime_error(std::string("the field ") + needed + " is missing");
    }
    return fields;
}

void checkBinLayout(const std::filesystem::path& file, const Bytes& bytes, std::size_t numbers) {
    constexpr double kMaxInOrder = 0.1, kMinContradicted = 0.3;  // [rad]; in fact 0.01 and 1.5
    constexpr std::size_t kMax = 8;
    const auto step = azimuthStep(bytes, numbers);
    if (step && *step < kMinContradicted) return;
    for (std::size_t other = 3; other <= kMax; ++other) {
        if (other == numbers || bytes.size() % (sizeof(float) * other) != 0) continue;
        if (azimuthStep(bytes, other).value_or(kMaxInOrder) >= kMaxInOrder) continue;
        std::string fields = other > 3 ? "x,y,z,i" : "x,y,z";
        for (std::size_t i = kKittiNumbers; i < other; ++i) fields += ",-";
        throw BrokenRecording(file.string() + ": neighbouring points do not fit " +
                              std::to_string(numbers) + " numbers per point, but " +
                              std::to_string(other) + "; state their meaning: rawlog-segment " +
                              "--bin-fields " + fields + " (r: ring, t: time, -: skipped)");
    }
}

bool isAllZero(const Bytes& bytes) {
    return std::all_of(bytes.begin(), bytes.end(), [](auto byte) { return byte == 0; });
}

bool mayBeBin(const Bytes& start) {
    return !isPacked(start) && (arePoints(start, 4) || arePoints(start, 5));
}

std::size_t binNumbersPerPoint(const Bytes& bytes) {
    const Bytes start = startOfReturns(bytes);
    if (isPacked(start)) return 0;
    const std::size_t without_rings = arePoints(start, 4) ? 4 : 0;
    if (!arePoints(start, 5)) return without_rings;
    const FifthNumbers fifths = fifthsOf(start);
    if (!fifths.are_whole) return without_rings;
    if (areRings(fifths) && fifths.of_returns.size() > 1) return 5;
    // If there is only one ring or there are few returns, check all points.
    const bool may_have_rings = without_rings > 0 || start.size() >= kStart;
    return may_have_rings && areRings(fifthsOf(bytes)) ? 5 : without_rings;
}

CloudFile readBin(const std::filesystem::path& file, Bytes bytes, const BinFields& stated) {
    BinFields fields = stated;
    if (fields.empty()) {
        const Bytes start = startOfReturns(bytes);
        const std::size_t numbers = binNumbersPerPoint(bytes);
        checkBinLayout(file, bytes, numbers == 0 ? kKittiNumbers : numbers);
        // A truncated file may lack complete points.
        const bool may_be_cut = bytes.size() % 16 != 0;
        if (numbers == 0 && !may_be_cut && !isAllZero(start)) {
            throw BrokenRecording(file.string() + ": " + whyNoCloud(start));
        }
        fields = {"x", "y", "z", "intensity"};
        if (numbers == 5) fields.emplace_back("ring");
    }
    CloudFile cloud;
    const std::size_t bytes_per_point = sizeof(float) * fields.size();
    for (std::size_t i = 0; i < fields.size(); ++i) {
        if (fields[i] == "-") continue;
        cloud.table.fields.push_back({fields[i], NumberType::Float32, sizeof(float) * i, 1});
    }
    if (bytes.size() % bytes_per_point != 0) {
        throw BrokenRecording(file.string() + ": " + std::to_string(bytes.size()) +
                              " bytes are not a multiple of " + std::to_string(bytes_per_point) +
                              "-byte points; is it truncated, or does it have other fields "
                              "(rawlog-segment --bin-fields)?");
    }
    checkNumber(file, bytes.size() / bytes_per_point);
    cloud.table.bytes_per_point = bytes_per_point;
    cloud.table.points = bytes.size() / bytes_per_point;
    cloud.table.bytes = std::move(bytes);
    return cloud;
}

}  // namespace hagen::recordings
