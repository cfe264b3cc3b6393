#pragma once
#include <hagen/scan/Scan.h>
#include <hagen/scan/SensorModel.h>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace hagen {

/// A sensor recovered from a cloud.
struct RecoveredBeams {
    /// Range limits are 0 and 1000 m, so that every return enters the image. `has_rings` is true if
    /// the beams are real, false if the rows are virtual. The name is that of the known model with
    /// these beams, otherwise kRecoveredName.
    SensorModel sensor;
    /// The share of returns on a beam: within 0.25 degrees and within a quarter of the distance to
    /// the next beam. Without rings, the share for the best beams found.
    float share = 0.0f;
    /// The beams with returns, ascending; empty without rings. A known model may have more beams.
    std::vector<float> seen_rad;
    /// The largest number of columns per revolution that the returns still fill.
    int max_columns = 0;
    /// The row of each ring, by ring number; -1 if the ring has too few returns. Empty if the
    /// returns have no ring numbers, or if the numbers do not match beams (ringBeams()).
    std::vector<int> row_of_ring;
    bool has_unfit_rings = false;  ///< ring numbers are ignored because they match no beams
};

/// The name of a recovered sensor that is not a known model.
constexpr const char* kRecoveredName = "recovered";

/// Minimum number of returns for finding beams.
constexpr std::size_t kMinReturnsForBeams = 400;

/// Recovers the beams of a spinning sensor from the coordinates of one of its scans. Ignores range,
/// azimuth and row. Returns nullopt if fewer than kMinReturnsForBeams returns have a range.
///
/// Beams are 2 to 256 arbitrarily spaced peaks in the density of elevations. A peak is significant
/// if the density falls to less than half on both sides, by more than four standard deviations of
/// the counts. Several bandwidths are tried, and the beams with the highest share are chosen.
///
/// The scan has rings if at least 85 % of its returns lie on beams (RecoveredBeams::share); random
/// elevations reach at most 55 %. The margin tolerates jitter, rounding, dropouts and a few percent
/// of stray returns. A cloud from a sensor without rings, or with rings blurred by deskewing or
/// tilting, has none. If in doubt, no rings are assumed, because virtual rows only blur surfaces,
/// but wrong beams tear them apart.
///
/// If all beams match a known model within 0.1 degrees, the sensor gets all beams of that model,
/// because some may have hit only sky. At least five beams, 30 % of the model's beams, and three
/// quarters of those between the lowest and the highest must match.
///
/// Virtual rows are evenly spaced over the elevations of all but the lowest and highest 0.1 % of
/// the returns. As in the Mid-360 preset, pixels are 2.5 times as high as wide, and there are 0.43
/// pixels per return, which determines `max_columns` and the initial number of rows (at most 256).
/// The number of rows is then reduced (to at least 16) until three quarters of the pixels between
/// the lowest and the highest return of their column have returns (gaps of more than four pixels
/// are sky), because returns of blurred rings are much denser in azimuth than in elevation.
std::optional<RecoveredBeams> recoverBeams(const Scan& scan);

/// Like recoverBeams(), but uses the sensor's ring number of each return: a ring's beam is at the
/// median elevation of its returns. Returns nullopt if fewer than kMinReturnsForBeams returns have
/// a range, or if the numbers do not match beams:
///
/// - 3 to 256 rings must have at least five returns; all others together at most 5 % of the
/// returns.
/// - Elevations must strictly increase or strictly decrease with the ring number.
/// - At least 85 % of the returns must be closer to their own ring than to any other: lines overlap
///   if a sensor scans without rings, or if the cloud is tilted.
///
/// As above, the sensor is a known model if its beams match. `share`: share of returns that are
/// closest to their own ring.
std::optional<RecoveredBeams> ringBeams(const Scan& scan, const std::vector<std::int32_t>& rings);

}  // namespace hagen
