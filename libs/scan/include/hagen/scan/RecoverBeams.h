#pragma once
#include <hagen/scan/Scan.h>
#include <hagen/scan/SensorModel.h>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace hagen {

/// The sensor of a cloud, as the cloud itself shows it.
struct RecoveredBeams {
    /// Ranges are 0 to 1000 m, so that every return enters the image. `has_rings` says whether the
    /// beams are real; otherwise its rows are virtual. The name is that of a known model whose
    /// beams these are, otherwise kRecoveredName.
    SensorModel sensor;
    /// With rings, the share of the returns that lie on a beam: not farther from it than a quarter
    /// of the way to the next beam, nor than 0.25 degrees. Otherwise of the best beams found.
    float share = 0.0f;
    /// The beams that have returns, ascending; empty without rings. A known model may have more.
    std::vector<float> seen_rad;
    /// The most columns per revolution that the returns fill.
    int most_columns = 0;
    /// The row of each ring that the returns are numbered with, by its number; -1: too few returns
    /// to tell. Empty if they are not, or if the numbers are not those of beams (ringBeams()).
    std::vector<int> row_of_ring;
    bool has_unfit_rings = false;  ///< numbers are there, but not of beams: not used
};

/// The name of a recovered sensor that is no known model.
constexpr const char* kRecoveredName = "recovered";

/// Fewer returns than this do not show beams.
constexpr std::size_t kMinReturnsForBeams = 400;

/// Recovers the beams of a spinning sensor from the coordinates of one of its scans; range, azimuth
/// and row are not used. None if fewer than kMinReturnsForBeams returns have a range.
///
/// Beams are peaks in the density of elevations, 2 to 256 of them, spaced at will. A peak counts if
/// the density falls to less than half on both sides, by more than four standard deviations of the
/// counts. Peaks are sought with several bandwidths; the beams with the highest share are taken.
///
/// The scan has rings if at least 85 % of its returns lie on beams (RecoveredBeams::share); chance
/// gives 55 % at most. Hence jitter, rounding, dropouts and a few percent of stray returns are no
/// obstacle. A sensor without rings has none, nor has a cloud whose rings were blurred by deskewing
/// or tilting. Doubt means no rings: virtual rows only blur, wrong beams tear surfaces apart.
///
/// If all beams are those of a known model, within 0.1 degrees, the sensor has all beams of that
/// model: some met nothing but sky. They must be at least five, 30 % of the model's, and three
/// quarters of the model's between the lowest and the highest.
///
/// Virtual rows are evenly spaced over the elevations of all but the lowest and highest 0.1 % of
/// the returns. As in the preset for a Mid-360, pixels are two and a half times as high as wide and
/// there are 0.43 of them per return, which gives `most_columns` and the most rows, 256 at most.
/// Rows are then made fewer, but not fewer than 16, until three quarters of the pixels between
/// others of their column have returns (gaps of more than four pixels are sky and do not count):
/// rings that are blurred are much closer in azimuth than in elevation.
std::optional<RecoveredBeams> recoverBeams(const Scan& scan);

/// The same from the ring of each return, as its sensor numbered them: the beam of a ring is at the
/// median elevation of its returns. None if fewer than kMinReturnsForBeams returns have a range,
/// or if the numbers cannot be those of beams:
///
/// - There must be 3 to 256 rings with at least five returns, all others together at most 5 %.
/// - Elevations must rise strictly with the number, or fall.
/// - At least 85 % of the returns must be closer to their own ring than to any other: the lines of
///   a sensor that scans without rings overlap, and a tilted cloud's do.
///
/// As above, the sensor is a known model if the beams are that model's. `share` is that of the
/// returns that are closest to their own ring.
std::optional<RecoveredBeams> ringBeams(const Scan& scan, const std::vector<std::int32_t>& rings);

}  // namespace hagen
