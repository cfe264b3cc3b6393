#include <hagen/scan/Image.h>
#include <hagen/scan/Scan.h>
#include <algorithm>
#include <array>
#include <stdexcept>

#include "scan/StartWithInstructionSets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "scan/Scan.cpp"
#include <hwy/foreach_target.h>
// Must follow foreach_target.h.
#include <hwy/highway.h>

#ifndef HAGEN_RANGE_IMAGE_SCAN_ONCE
#define HAGEN_RANGE_IMAGE_SCAN_ONCE
namespace hagen {
namespace {

/// Finds the row of the closest beam from the sine of the elevation, z / range, which avoids an arc
/// sine. The row is the number of midpoints between neighbouring beams below the sine. A table over
/// the sine counts the midpoints in lower bins; the midpoints in the same bin (usually none, at
/// most 1 even for 64 beams) are compared.
struct RowTable {
    static constexpr int kBins = 1024;
    static constexpr float kBinsPerSine = kBins / 2;

    explicit RowTable(const SensorModel& sensor) {
        std::array<int, kBins> midpoints_in_bin{};
        midpoint_sine.fill(std::numeric_limits<float>::infinity());
        for (std::size_t row = 0; row + 1 < sensor.elevations_rad.size(); ++row) {
            if (row + 1 >= midpoint_sine.size() || !std::isfinite(sensor.elevations_rad[row]) ||
                !std::isfinite(sensor.elevations_rad[row + 1])) {
                throw std::invalid_argument("sensor " + sensor.name +
                                            ": must have at most 256 beams, "
                                            "with finite elevations");
            }
            const double lower_rad = static_cast<double>(sensor.elevations_rad[row]);
            const double upper_rad = static_cast<double>(sensor.elevations_rad[row + 1]);
            midpoint_sine[row] = static_cast<float>(std::sin(0.5 * (lower_rad + upper_rad)));
            ++midpoints_in_bin[binOf(midpoint_sine[row])];
        }
        int row = 0;
        for (int bin = 0; bin < kBins; ++bin) {
            lowest_row[bin] = row;
            row += midpoints_in_bin[bin];
            max_midpoints_in_bin = std::max(max_midpoints_in_bin, midpoints_in_bin[bin]);
        }
    }

    /// Uses the same arithmetic as rowOf() below.
    static int binOf(float sine) {
        return static_cast<int>(std::min((sine + 1.0f) * kBinsPerSine, kBins - 1.0f));
    }

    std::array<float, 256> midpoint_sine;  ///< between rows r and r + 1; infinite if unused
    std::array<std::int32_t, kBins> lowest_row;
    int max_midpoints_in_bin = 0;
};

/// Arrays of points, and their ranges, azimuths and rows (output).
struct Beams {
    const float *x_m, *y_m, *z_m;
    float *range_m, *azimuth_rad;
    std::uint8_t* row;
};

}  // namespace
}  // namespace hagen
#endif

HWY_BEFORE_NAMESPACE();
namespace hagen {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

/// The arc tangent of ratios in [0, 1], within 2e-7.
template <class V>
V arcTangent(V ratio) {
    const hn::DFromV<V> d;
    constexpr float kCoefficients[] = {0.0242524034f, -0.0594863936f, 0.0991429286f, -0.140194809f,
                                       0.199697239f,  -0.333319907f,  0.999999901f};
    const V square = hn::Mul(ratio, ratio);
    V sum = hn::Set(d, -0.00469327608f);
    for (const float coefficient : kCoefficients) {
        sum = hn::Add(hn::Mul(sum, square), hn::Set(d, coefficient));
    }
    return hn::Mul(sum, ratio);
}

/// atan2(y, x), within 5e-7; treats zeros and signs like std::atan2.
template <class V>
V azimuthOf(V x, V y) {
    const hn::DFromV<V> d;
    const V along = hn::Abs(x), across = hn::Abs(y);
    const V longer = hn::Max(along, across), shorter = hn::Min(along, across);
    const V ratio = hn::IfThenElse(hn::Gt(longer, hn::Zero(d)), hn::Div(shorter, longer), longer);
    V angle = arcTangent(ratio);
    angle =
        hn::IfThenElse(hn::Gt(across, along), hn::Sub(hn::Set(d, 1.57079632679f), angle), angle);
    const hn::RebindToSigned<decltype(d)> d_int;  // sign bits, also of zeros
    const auto is_behind = hn::RebindMask(d, hn::Lt(hn::BitCast(d_int, x), hn::Zero(d_int)));
    angle = hn::IfThenElse(is_behind, hn::Sub(hn::Set(d, 3.14159265359f), angle), angle);
    return hn::CopySignToAbs(angle, y);
}

/// The rows of sines within [-1, 1].
template <class V>
auto rowOf(V sine, const RowTable& table) {
    const hn::DFromV<V> d;
    const hn::RebindToSigned<decltype(d)> d_int;
    const V from_lowest =
        hn::Mul(hn::Add(sine, hn::Set(d, 1.0f)), hn::Set(d, RowTable::kBinsPerSine));
    const auto bin = hn::ConvertTo(
        d_int, hn::Min(hn::Max(from_lowest, hn::Zero(d)), hn::Set(d, RowTable::kBins - 1.0f)));
    auto row = hn::GatherIndex(d_int, table.lowest_row.data(), bin);
    for (int i = 0; i < table.max_midpoints_in_bin; ++i) {
        const V midpoint = hn::GatherIndex(d, table.midpoint_sine.data(), row);
        const auto is_above = hn::VecFromMask(d, hn::Gt(sine, midpoint));  // -1 or 0
        row = hn::Sub(row, hn::BitCast(d_int, is_above));
    }
    return row;
}

/// Processes one vector of points.
template <class D>
HWY_INLINE void locateVector(D d, const RowTable& table, const Beams& at) {
    const auto x = hn::LoadU(d, at.x_m), y = hn::LoadU(d, at.y_m), z = hn::LoadU(d, at.z_m);
    const auto square = hn::Add(hn::Add(hn::Mul(x, x), hn::Mul(y, y)), hn::Mul(z, z));
    const auto range = hn::Sqrt(square);
    const auto infinite = hn::Set(d, std::numeric_limits<float>::infinity());
    const auto is_somewhere =
        hn::And(hn::Gt(range, hn::Zero(d)), hn::Lt(range, infinite));  // false for NaN
    const auto sine = hn::IfThenElseZero(is_somewhere, hn::Div(z, range));
    const auto row = hn::IfThenElseZero(hn::RebindMask(hn::RebindToSigned<D>(), is_somewhere),
                                        rowOf(sine, table));
    hn::StoreU(hn::IfThenElse(is_somewhere, range, hn::Set(d, kNoValue)), d, at.range_m);
    hn::StoreU(hn::IfThenElseZero(is_somewhere, azimuthOf(x, y)), d, at.azimuth_rad);
    const hn::Rebind<std::uint8_t, D> d_row;
    hn::StoreU(hn::DemoteTo(d_row, row), d_row, at.row);
}

void locateAll(const RowTable& table, Beams beams, std::size_t count) {
    const hn::ScalableTag<float> d;
    constexpr std::size_t kMax = hn::MaxLanes(d);
    const std::size_t lanes = hn::Lanes(d);
    std::size_t i = 0;
    for (; i + lanes <= count; i += lanes) {
        locateVector(d, table,
                     {beams.x_m + i, beams.y_m + i, beams.z_m + i, beams.range_m + i,
                      beams.azimuth_rad + i, beams.row + i});
    }
    if (i == count) return;
    float x_m[kMax] = {}, y_m[kMax] = {}, z_m[kMax] = {};  // the last vector is padded
    float range_m[kMax], azimuth_rad[kMax];
    std::uint8_t row[kMax];
    std::copy(beams.x_m + i, beams.x_m + count, x_m);
    std::copy(beams.y_m + i, beams.y_m + count, y_m);
    std::copy(beams.z_m + i, beams.z_m + count, z_m);
    locateVector(d, table, {x_m, y_m, z_m, range_m, azimuth_rad, row});
    std::copy_n(range_m, count - i, beams.range_m + i);
    std::copy_n(azimuth_rad, count - i, beams.azimuth_rad + i);
    std::copy_n(row, count - i, beams.row + i);
}

}  // namespace HWY_NAMESPACE
}  // namespace hagen
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace hagen {
namespace {

HWY_EXPORT(locateAll);

const bool kStarted = startWithInstructionSets();

}  // namespace

void Scan::clear() {
    for (auto* values : {&x_m, &y_m, &z_m, &intensity, &range_m, &azimuth_rad, &time_s}) {
        values->clear();
    }
    row.clear();
    beams = {};
}

void Scan::reserve(std::size_t returns) {
    for (auto* values : {&x_m, &y_m, &z_m, &intensity, &range_m, &azimuth_rad, &time_s}) {
        values->reserve(returns);
    }
    row.reserve(returns);
}

// Processes a vector of points at a time: rows need no angle (RowTable), and azimuths are
// polynomials.
void locateBeams(const SensorModel& sensor, Scan& scan) {
    scan.range_m.resize(scan.size());
    scan.azimuth_rad.resize(scan.size());
    scan.row.resize(scan.size());
    scan.beams = beamSpan(sensor);
    const RowTable table(sensor);
    HWY_DYNAMIC_DISPATCH(locateAll)
    (table,
     {scan.x_m.data(), scan.y_m.data(), scan.z_m.data(), scan.range_m.data(),
      scan.azimuth_rad.data(), scan.row.data()},
     scan.size());
}

}  // namespace hagen
#endif
