#include <hagen/scan/Angle.h>
#include <hagen/scan/ColumnMap.h>
#include <hagen/scan/RangeImage.h>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstring>

#include "scan/CheckRows.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "scan/RangeImage.cpp"
#include <hwy/foreach_target.h>
// Must follow foreach_target.h.
#include <hwy/highway.h>

#ifndef HAGEN_RANGE_IMAGE_RANGE_IMAGE_ONCE
#define HAGEN_RANGE_IMAGE_RANGE_IMAGE_ONCE
namespace hagen {
namespace {

/// Converts an azimuth in radians to turns.
constexpr float kTurnsPerRadian = static_cast<float>(0.5 / kPi);

/// Number of returns projected at a time.
constexpr std::size_t kTogether = 128;

struct Projection {
    int rows, columns;  ///< number of columns of the whole turn
    float min_m, max_m;
    const std::int32_t* to_image;  ///< maps columns of the turn to the image; null: identity
};

/// Arrays of a scan's returns, and their pixels (output).
struct Returns {
    const float *range_m, *azimuth_rad;
    const std::uint8_t* row;
    std::int32_t* depth_mapper;
};

/// A return packed into one number: the bits of its range above those of its index, read as a
/// double. The minimum of two is the closer return, or the first if equally close. (A minimum of
/// doubles avoids an unpredictable branch.)
using RangeAndIndex = double;

/// Range and index bits of an empty pixel. Read as a double, greater than any return.
constexpr std::int32_t kNoValueBits = 0x7fc00000;

/// A batch of projected returns, for keepClosest().
struct Projected {
    std::int32_t pixel[kTogether];  ///< within the image, even for dropped returns
    RangeAndIndex found[kTogether];
};

}  // namespace
}  // namespace hagen
#endif

HWY_BEFORE_NAMESPACE();
namespace hagen {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

/// nearestColumn() of a vector of azimuths.
template <class V>
auto nearestColumns(V azimuth_rad, int columns) {
    const hn::DFromV<V> d;
    const hn::RebindToSigned<decltype(d)> d_int;
    const V turn = hn::Sub(hn::Set(d, 0.5f), hn::Mul(azimuth_rad, hn::Set(d, kTurnsPerRadian)));
    const V columns_before = hn::Floor(hn::Mul(turn, hn::Set(d, static_cast<float>(columns))));
    const auto zero = hn::Zero(d_int), last = hn::Set(d_int, columns - 1);
    const auto turn_columns = hn::Set(d_int, columns);
    auto column = hn::ConvertTo(d_int, columns_before);
    column = hn::Add(column, hn::IfThenElseZero(hn::Lt(column, zero), turn_columns));
    column = hn::Sub(column, hn::IfThenElseZero(hn::Gt(column, last), turn_columns));
    return hn::Min(hn::Max(column, zero), last);  // within the image even for NaN
}

void projectTogether(Projection to, Returns returns, std::int32_t first_index,
                     Projected& projected) {
    const hn::CappedTag<float, kTogether> d;
    const hn::RebindToSigned<decltype(d)> d_int;
    const hn::Rebind<std::uint8_t, decltype(d)> d_row;
    const auto in_order = hn::Iota(d_int, first_index);
    for (std::size_t i = 0; i < kTogether; i += hn::Lanes(d)) {
        auto column = nearestColumns(hn::LoadU(d, returns.azimuth_rad + i), to.columns);
        if (to.to_image != nullptr) column = hn::GatherIndex(d_int, to.to_image, column);
        const auto row = hn::PromoteTo(d_int, hn::LoadU(d_row, returns.row + i));
        const auto pixel = hn::Add(hn::Mul(column, hn::Set(d_int, to.rows)), row);
        hn::StoreU(pixel, d_int, projected.pixel + i);

        const auto range_m = hn::LoadU(d, returns.range_m + i);
        const auto is_in = hn::RebindMask(d_int, hn::And(hn::Ge(range_m, hn::Set(d, to.min_m)),
                                                         hn::Le(range_m, hn::Set(d, to.max_m))));
        hn::StoreU(hn::IfThenElse(is_in, pixel, hn::Set(d_int, RangeImage::kNoPixel)), d_int,
                   returns.depth_mapper + i);
        const auto index = hn::Add(in_order, hn::Set(d_int, static_cast<std::int32_t>(i)));
        hn::StoreInterleaved2(
            hn::IfThenElse(is_in, index, hn::Set(d_int, RangeImage::kNoReturn)),
            hn::IfThenElse(is_in, hn::BitCast(d_int, range_m), hn::Set(d_int, kNoValueBits)), d_int,
            reinterpret_cast<std::int32_t*>(projected.found + i));
    }
}

}  // namespace HWY_NAMESPACE
}  // namespace hagen
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace hagen {
namespace {

HWY_EXPORT(projectTogether);

RangeAndIndex emptyPixel() {
    const std::uint64_t bits = std::uint64_t{kNoValueBits} << 32 | 0xffffffff;
    RangeAndIndex empty;
    std::memcpy(&empty, &bits, sizeof empty);
    return empty;
}

void keepClosest(const Projected& projected, std::size_t count, RangeAndIndex* closest) {
    for (std::size_t i = 0; i < count; ++i) {
        const RangeAndIndex found = projected.found[i], so_far = closest[projected.pixel[i]];
        closest[projected.pixel[i]] = found < so_far ? found : so_far;  // one instruction
    }
}

void split(const RangeAndIndex* closest, std::size_t pixels, float* depth_m,
           std::int32_t* closest_return) {
    for (std::size_t pixel = 0; pixel < pixels; ++pixel) {
        std::uint64_t both;
        std::memcpy(&both, closest + pixel, sizeof both);
        const auto bits = static_cast<std::uint32_t>(both >> 32);
        std::memcpy(depth_m + pixel, &bits, sizeof bits);
        closest_return[pixel] = static_cast<std::int32_t>(both & 0xffffffff);
    }
}

/// Projects a scan in batches of `kTogether` returns.
void projectReturns(const Scan& scan, const Projection& to, std::int32_t* depth_mapper,
                    RangeAndIndex* closest) {
    Projected projected;
    std::size_t first = 0;
    for (; first + kTogether <= scan.size(); first += kTogether) {
        HWY_DYNAMIC_DISPATCH(projectTogether)
        (to,
         {scan.range_m.data() + first, scan.azimuth_rad.data() + first, scan.row.data() + first,
          depth_mapper + first},
         static_cast<std::int32_t>(first), projected);
        keepClosest(projected, kTogether, closest);
    }
    // The last batch is padded.
    const std::size_t rest = scan.size() - first;
    float range_m[kTogether] = {}, azimuth_rad[kTogether] = {};
    std::uint8_t row[kTogether] = {};
    std::int32_t pixel[kTogether];
    std::copy_n(scan.range_m.data() + first, rest, range_m);
    std::copy_n(scan.azimuth_rad.data() + first, rest, azimuth_rad);
    std::copy_n(scan.row.data() + first, rest, row);
    HWY_DYNAMIC_DISPATCH(projectTogether)
    (to, {range_m, azimuth_rad, row, pixel}, static_cast<std::int32_t>(first), projected);
    keepClosest(projected, rest, closest);
    std::copy_n(pixel, rest, depth_mapper + first);
}

// Computes the pixels of a vector of returns at a time and finds the closest returns without
// branches.
void project(const Scan& scan, const SensorModel& sensor, const Projection& to, int image_columns,
             RangeImage& image, ProjectionWorkspace& work) {
    checkRows(scan, sensor);
    std::vector<RangeAndIndex>& closest = work.closest;
    closest.assign(static_cast<std::size_t>(to.rows) * image_columns, emptyPixel());
    image.depth_mapper.resize(scan.size());
    projectReturns(scan, to, image.depth_mapper.data(), closest.data());
    image.depth_m.resize(to.rows, image_columns);
    image.closest_return.resize(to.rows, image_columns);
    split(closest.data(), closest.size(), image.depth_m.data(), image.closest_return.data());
}

}  // namespace

void projectScan(const Scan& scan, const SensorModel& sensor, int columns, float context_m,
                 RangeImage& image, ProjectionWorkspace& work) {
    const float max_m = std::min(sensor.max_range_m, context_m);
    project(scan, sensor, {sensor.rows(), columns, sensor.min_range_m, max_m, nullptr}, columns,
            image, work);
}

void projectScan(const Scan& scan, const SensorModel& sensor, const ColumnMap& map, float context_m,
                 RangeImage& image, ProjectionWorkspace& work) {
    const float max_m = std::min(sensor.max_range_m, context_m);
    project(scan, sensor,
            {sensor.rows(), map.columns(), sensor.min_range_m, max_m, map.to_image.data()},
            static_cast<int>(map.to_turn.size()), image, work);
}

void preferFirst(const Scan& scan, std::size_t first, RangeImage& image) {
    const auto end = static_cast<std::int32_t>(first);
    for (std::int32_t i = 0; i < end; ++i) {
        const std::int32_t pixel = image.depth_mapper[i];
        if (pixel == RangeImage::kNoPixel) continue;
        std::int32_t& closest = image.closest_return.data()[pixel];
        float& depth_m = image.depth_m.data()[pixel];
        if (closest < end && scan.range_m[i] >= depth_m) continue;
        closest = i;
        depth_m = scan.range_m[i];
    }
}

int nearestColumn(float azimuth_rad, int columns) {
    const float turn = 0.5f - azimuth_rad * kTurnsPerRadian;  // clockwise from behind
    const int column = static_cast<int>(std::floor(turn * static_cast<float>(columns)));
    return wrapColumn(column, columns);
}

float columnAzimuth(int column, int columns) {
    return static_cast<float>(kPi - 2.0 * kPi * (column + 0.5) / columns);
}

}  // namespace hagen
#endif
