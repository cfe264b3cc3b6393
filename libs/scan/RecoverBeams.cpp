#include <hagen/scan/Angle.h>
#include <hagen/scan/RecoverBeams.h>
#include <algorithm>
#include <array>
#include <cmath>
#include <map>

namespace hagen {
namespace {

constexpr float kFarthest_m = 1000.0f;  // max. range in settings; exceeds all sensors
constexpr int kMaxBeams = 256;
constexpr double kMinShare = 0.85;

// Bin width of the histograms of elevations.
constexpr double kBin_deg = 0.01;
constexpr int kBins = 18001;

/// Directions of the returns with a range, in degrees.
struct Directions {
    std::vector<double> elevation_deg, azimuth_deg;
    std::vector<std::size_t> index;
    std::size_t size() const { return elevation_deg.size(); }
};

Directions directionsOf(const Scan& scan) {
    Directions directions;
    directions.elevation_deg.reserve(scan.size());
    directions.azimuth_deg.reserve(scan.size());
    directions.index.reserve(scan.size());
    for (std::size_t i = 0; i < scan.size(); ++i) {
        const double x = scan.x_m[i], y = scan.y_m[i], z = scan.z_m[i];
        const double level_m = std::hypot(x, y);
        if (!std::isfinite(level_m + z) || (level_m == 0 && z == 0)) continue;
        directions.elevation_deg.push_back(degrees(std::atan2(z, level_m)));
        directions.azimuth_deg.push_back(degrees(std::atan2(y, x)));
        directions.index.push_back(i);
    }
    return directions;
}

// Peaks of the density.

int binOf(double elevation_deg) { return static_cast<int>((elevation_deg + 90.0) / kBin_deg); }

/// Number of returns within `half` bins on either side, for each bin.
std::vector<int> countsWithin(const std::vector<int>& histogram, int half) {
    std::vector<int> counts(kBins, 0);
    int sum = 0;
    for (int bin = -half; bin < kBins; ++bin) {
        if (bin + half < kBins) sum += histogram[bin + half];
        if (bin - half - 1 >= 0) sum -= histogram[bin - half - 1];
        if (bin >= 0) counts[bin] = sum;
    }
    return counts;
}

/// True if a peak is significantly higher than the valley beside it.
bool standsOut(int peak, int valley) {
    return valley < 0.5 * peak && peak - valley > 4.0 * std::sqrt(static_cast<double>(peak));
}

/// The bins of significant peaks, ascending.
std::vector<int> peaksOf(const std::vector<int>& counts) {
    std::vector<int> peaks;
    int top = 0, valley = 0;  // the highest bin since the last valley, and the lowest since the top
    bool is_rising = true;    // since a significant valley
    for (int bin = 0; bin < kBins; ++bin) {
        if (is_rising) {
            if (counts[bin] > counts[top]) top = bin;
            if (standsOut(counts[top], counts[bin])) {
                int last = top;  // last bin of a flat top
                while (counts[last + 1] == counts[top]) ++last;
                peaks.push_back((top + last) / 2);
                is_rising = false;
                valley = bin;
            }
        } else {
            if (counts[bin] < counts[valley]) valley = bin;
            if (standsOut(counts[bin], counts[valley])) {
                is_rising = true;
                top = bin;
            }
        }
    }
    return peaks;
}

// Finding beams from peaks.

/// Half-widths of the beams. Returns within the half-width lie on the beam.
std::vector<double> reachesOf(const std::vector<double>& beams_deg) {
    std::vector<double> reaches_deg(beams_deg.size(), 0.25);
    for (std::size_t beam = 1; beam < beams_deg.size(); ++beam) {
        const double quarter_deg = 0.25 * (beams_deg[beam] - beams_deg[beam - 1]);
        reaches_deg[beam - 1] = std::min(reaches_deg[beam - 1], quarter_deg);
        reaches_deg[beam] = std::min(reaches_deg[beam], quarter_deg);
    }
    return reaches_deg;
}

/// The returns on each beam, as index ranges in the ascending elevations.
struct Ranks {
    std::ptrdiff_t from, to;
};
Ranks returnsOn(double beam_deg, double reach_deg, const std::vector<double>& ascending_deg) {
    const auto begin = ascending_deg.begin(), end = ascending_deg.end();
    const auto from = std::lower_bound(begin, end, beam_deg - reach_deg);
    return {from - begin, std::upper_bound(from, end, beam_deg + reach_deg) - begin};
}

double shareOn(const std::vector<double>& beams_deg, const std::vector<double>& ascending_deg) {
    const std::vector<double> reaches_deg = reachesOf(beams_deg);
    std::ptrdiff_t on_beams = 0;
    for (std::size_t beam = 0; beam < beams_deg.size(); ++beam) {
        const Ranks ranks = returnsOn(beams_deg[beam], reaches_deg[beam], ascending_deg);
        on_beams += ranks.to - ranks.from;
    }
    return static_cast<double>(on_beams) / static_cast<double>(ascending_deg.size());
}

/// Moves each beam to the median of the returns within its reach.
void centre(const std::vector<double>& reaches_deg, const std::vector<double>& ascending_deg,
            std::vector<double>& beams_deg) {
    for (std::size_t beam = 0; beam < beams_deg.size(); ++beam) {
        const Ranks ranks = returnsOn(beams_deg[beam], reaches_deg[beam], ascending_deg);
        if (ranks.from < ranks.to) beams_deg[beam] = ascending_deg[(ranks.from + ranks.to) / 2];
    }
}

struct Beams {
    std::vector<double> elevations_deg;
    double share = 0;
};

/// Returns the beams with the highest share; no beams if none were found.
Beams bestBeams(const std::vector<double>& ascending_deg) {
    std::vector<int> histogram(kBins, 0);
    for (const double elevation_deg : ascending_deg) ++histogram[binOf(elevation_deg)];
    Beams best;
    for (const int half : {20, 10, 5, 2, 1}) {
        Beams beams;
        for (const int peak : peaksOf(countsWithin(histogram, half))) {
            beams.elevations_deg.push_back((peak + 0.5) * kBin_deg - 90.0);
        }
        const std::size_t count = beams.elevations_deg.size();
        if (count < 2 || count > kMaxBeams) continue;
        // The peak of a narrow beam is as wide as the bandwidth, and the beam may be off its
        // centre.
        centre(std::vector<double>(count, (half + 0.5) * kBin_deg), ascending_deg,
               beams.elevations_deg);
        centre(reachesOf(beams.elevations_deg), ascending_deg, beams.elevations_deg);
        beams.share = shareOn(beams.elevations_deg, ascending_deg);
        // Narrower bandwidths may split a beam, so they must be clearly better.
        if (beams.share > best.share + 0.005) best = std::move(beams);
    }
    return best;
}

/// Returns the known model that has all of these beams, if there are at least five, 30 % of the
/// model's beams, and three quarters of those between the lowest and the highest found.
std::optional<SensorModel> modelWith(const std::vector<double>& beams_deg) {
    const int beams = static_cast<int>(beams_deg.size());
    std::optional<SensorModel> model;
    for (const std::string& name : knownSensorModels()) {
        SensorModel known = sensorModel(name);
        if (!known.has_rings || beams < 5 || beams < 0.3 * known.rows()) continue;
        int first_row = -1, last_row = -1;
        const bool has_all = std::all_of(beams_deg.begin(), beams_deg.end(), [&](double beam_deg) {
            const int row = known.nearestRow(static_cast<float>(radians(beam_deg)));
            const bool is_new = row > last_row;
            last_row = row;
            if (first_row < 0) first_row = row;
            return is_new && std::abs(degrees(static_cast<double>(known.elevations_rad[row])) -
                                      beam_deg) < 0.1;
        });
        const bool is_dense = beams >= 0.75 * (last_row - first_row + 1);
        if (has_all && is_dense && (!model || known.rows() < model->rows()))
            model = std::move(known);
    }
    return model;
}

/// A sensor with these beams and unlimited range.
SensorModel sensorOf(const std::vector<double>& beams_deg) {
    SensorModel sensor = customSensorModel(beams_deg);
    sensor.name = kRecoveredName;
    sensor.min_range_m = 0.0f;
    sensor.max_range_m = kFarthest_m;
    return sensor;
}

/// Number of firings per revolution, from the azimuth steps between neighbouring returns.
int firingsOn(const std::vector<double>& beams_deg, const Directions& directions) {
    std::vector<std::vector<double>> azimuths_deg(beams_deg.size());
    for (std::size_t i = 0; i < directions.size(); ++i) {
        const double elevation_deg = directions.elevation_deg[i];
        std::size_t beam = static_cast<std::size_t>(
            std::lower_bound(beams_deg.begin(), beams_deg.end(), elevation_deg) -
            beams_deg.begin());
        if (beam == beams_deg.size() ||
            (beam > 0 && elevation_deg - beams_deg[beam - 1] < beams_deg[beam] - elevation_deg)) {
            --beam;
        }
        azimuths_deg[beam].push_back(directions.azimuth_deg[i]);
    }
    auto& max = *std::max_element(azimuths_deg.begin(), azimuths_deg.end(),
                                  [](auto& a, auto& b) { return a.size() < b.size(); });
    std::sort(max.begin(), max.end());
    std::vector<double> steps_deg;
    for (std::size_t i = 1; i < max.size(); ++i) {
        const double step_deg = max[i] - max[i - 1];
        if (step_deg > 0.02) steps_deg.push_back(step_deg);  // excludes dual returns
    }
    if (steps_deg.empty()) return 0;
    const auto third = steps_deg.begin() + static_cast<std::ptrdiff_t>(steps_deg.size() / 3);
    std::nth_element(steps_deg.begin(), third, steps_deg.end());
    return static_cast<int>(std::lround(360.0 / *third));
}

RecoveredBeams withBeams(const std::vector<double>& beams_deg, const Directions& directions) {
    RecoveredBeams recovered;
    recovered.sensor = sensorOf(beams_deg);
    recovered.seen_rad = recovered.sensor.elevations_rad;
    if (auto model = modelWith(beams_deg)) {
        recovered.sensor = std::move(*model);
        recovered.sensor.min_range_m = 0.0f;
        recovered.sensor.max_range_m = kFarthest_m;
    }
    recovered.max_columns = firingsOn(beams_deg, directions);
    return recovered;
}

// Virtual rows.

/// Total width of the 5-degree sectors with returns.
double seenAzimuth(const Directions& directions) {
    std::array<bool, 73> has_returns{};
    for (const double azimuth_deg : directions.azimuth_deg) {
        has_returns[static_cast<std::size_t>((azimuth_deg + 180.0) / 5.0)] = true;
    }
    return std::min(
        360.0, 5.0 * static_cast<double>(std::count(has_returns.begin(), has_returns.end(), true)));
}

/// The elevations covered by virtual rows.
struct Span {
    double lowest_deg, size_deg;
};

/// The share of pixels with returns, between the lowest and the highest return of each column.
/// Ignores long gaps, which are sky between objects.
double filledShare(const Directions& directions, const Span& span, int rows, int columns) {
    constexpr int kMaxGap = 4;
    std::vector<bool> has_return(static_cast<std::size_t>(rows) * columns);
    for (std::size_t i = 0; i < directions.size(); ++i) {
        const double height = (directions.elevation_deg[i] - span.lowest_deg) / span.size_deg;
        const double turn = (directions.azimuth_deg[i] + 180.0) / 360.0;
        const int row = static_cast<int>(std::floor(height * rows));
        const int column = std::min(static_cast<int>(turn * columns), columns - 1);
        if (row >= 0 && row < rows)
            has_return[static_cast<std::size_t>(column) * rows + row] = true;
    }
    long filled = 0, gaps = 0;
    for (int column = 0; column < columns; ++column) {
        int last_row = rows;  // last row with a return; `rows` if none yet
        for (int row = 0; row < rows; ++row) {
            if (!has_return[static_cast<std::size_t>(column) * rows + row]) continue;
            ++filled;
            const int gap = row - last_row - 1;
            if (gap > 0 && gap <= kMaxGap) gaps += gap;
            last_row = row;
        }
    }
    return static_cast<double>(filled) / static_cast<double>(std::max(filled + gaps, 1L));
}

RecoveredBeams virtualRows(const Directions& directions, const std::vector<double>& ascending_deg) {
    constexpr double kPixelsPerReturn = 0.43, kHeightPerWidth = 2.5, kMinSpan_deg = 1.0;
    constexpr double kMinFilled = 0.75;
    constexpr int kMinRows = 16, kMinColumns = 8;
    const std::size_t outside = ascending_deg.size() / 1000;
    Span span{ascending_deg[outside], 0};
    span.size_deg = ascending_deg[ascending_deg.size() - 1 - outside] - span.lowest_deg;
    if (span.size_deg < kMinSpan_deg) {
        const double middle_deg = span.lowest_deg + 0.5 * span.size_deg;
        span.lowest_deg = std::clamp(middle_deg - 0.5 * kMinSpan_deg, -90.0, 90.0 - kMinSpan_deg);
        span.size_deg = kMinSpan_deg;
    }
    const double pixels = kPixelsPerReturn * static_cast<double>(directions.size());
    const double seen_deg = seenAzimuth(directions);
    const double row_deg = std::sqrt(kHeightPerWidth * span.size_deg * seen_deg / pixels);
    int rows =
        std::clamp(static_cast<int>(std::lround(span.size_deg / row_deg)), kMinRows, kMaxBeams);
    RecoveredBeams recovered;
    recovered.max_columns =
        std::max(kMinColumns, static_cast<int>(std::lround(pixels / rows * 360.0 / seen_deg)));
    while (rows > kMinRows &&
           filledShare(directions, span, rows, recovered.max_columns) < kMinFilled) {
        rows -= std::max(1, rows / 20);
    }
    std::vector<double> elevations_deg(rows);
    for (int row = 0; row < rows; ++row) {
        elevations_deg[row] = span.lowest_deg + (row + 0.5) * span.size_deg / rows;
    }
    recovered.sensor = sensorOf(elevations_deg);
    recovered.sensor.has_rings = false;
    return recovered;
}

// Rings.

constexpr std::size_t kMinOnRing = 5;

/// The elevations of the returns on each ring, ascending.
using OnRings = std::map<std::int32_t, std::vector<double>>;

OnRings elevationsOnRings(const Directions& directions, const std::vector<std::int32_t>& rings) {
    OnRings on_rings;
    for (std::size_t i = 0; i < directions.size(); ++i) {
        on_rings[rings[directions.index[i]]].push_back(directions.elevation_deg[i]);
    }
    for (auto& [ring, elevations_deg] : on_rings) {
        std::sort(elevations_deg.begin(), elevations_deg.end());
    }
    return on_rings;
}

/// Number of returns that are closer to their own beam than to others; beams are ascending.
std::size_t closestToOwn(const std::vector<double>& beams_deg,
                         const std::vector<const std::vector<double>*>& elevations_deg) {
    std::ptrdiff_t closest = 0;
    for (std::size_t beam = 0; beam < beams_deg.size(); ++beam) {
        auto from = elevations_deg[beam]->begin(), to = elevations_deg[beam]->end();
        if (beam > 0) {
            from = std::lower_bound(from, to, 0.5 * (beams_deg[beam - 1] + beams_deg[beam]));
        }
        if (beam + 1 < beams_deg.size()) {
            to = std::upper_bound(from, to, 0.5 * (beams_deg[beam] + beams_deg[beam + 1]));
        }
        closest += to - from;
    }
    return static_cast<std::size_t>(closest);
}

}  // namespace

std::optional<RecoveredBeams> ringBeams(const Scan& scan, const std::vector<std::int32_t>& rings) {
    constexpr double kMaxOnOthers = 0.05;
    constexpr std::size_t kMinRings = 3;
    const Directions directions = directionsOf(scan);
    if (directions.size() < kMinReturnsForBeams) return std::nullopt;
    const auto returns = static_cast<double>(directions.size());
    const OnRings of_rings = elevationsOnRings(directions, rings);
    std::vector<std::int32_t> numbers;
    std::vector<double> beams_deg;
    std::vector<const std::vector<double>*> elevations_deg;
    std::size_t on_rings = 0;
    for (const auto& [ring, of_ring_deg] : of_rings) {
        if (ring < 0 || of_ring_deg.size() < kMinOnRing) continue;
        numbers.push_back(ring);
        beams_deg.push_back(of_ring_deg[of_ring_deg.size() / 2]);
        elevations_deg.push_back(&of_ring_deg);
        on_rings += of_ring_deg.size();
    }
    if (numbers.size() < kMinRings || numbers.size() > kMaxBeams) return std::nullopt;
    if (static_cast<double>(on_rings) < (1 - kMaxOnOthers) * returns) return std::nullopt;
    if (beams_deg.front() > beams_deg.back()) {
        std::reverse(numbers.begin(), numbers.end());
        std::reverse(beams_deg.begin(), beams_deg.end());
        std::reverse(elevations_deg.begin(), elevations_deg.end());
    }
    for (std::size_t i = 1; i < beams_deg.size(); ++i) {
        if (beams_deg[i] - beams_deg[i - 1] < kBin_deg) return std::nullopt;
    }
    const double share = static_cast<double>(closestToOwn(beams_deg, elevations_deg)) /
                         static_cast<double>(on_rings);
    if (share < kMinShare) return std::nullopt;

    RecoveredBeams recovered = withBeams(beams_deg, directions);
    recovered.share = static_cast<float>(share);
    recovered.row_of_ring.assign(
        static_cast<std::size_t>(*std::max_element(numbers.begin(), numbers.end())) + 1, -1);
    for (std::size_t i = 0; i < numbers.size(); ++i) {
        recovered.row_of_ring[static_cast<std::size_t>(numbers[i])] =
            recovered.sensor.nearestRow(recovered.seen_rad[i]);
    }
    return recovered;
}

std::optional<RecoveredBeams> recoverBeams(const Scan& scan) {
    const Directions directions = directionsOf(scan);
    if (directions.size() < kMinReturnsForBeams) return std::nullopt;
    std::vector<double> ascending_deg = directions.elevation_deg;
    std::sort(ascending_deg.begin(), ascending_deg.end());

    const Beams beams = bestBeams(ascending_deg);
    RecoveredBeams recovered = beams.share >= kMinShare
                                   ? withBeams(beams.elevations_deg, directions)
                                   : virtualRows(directions, ascending_deg);
    recovered.share = static_cast<float>(beams.share);
    return recovered;
}

}  // namespace hagen
