#include <hagen/filter/SectorFilter.h>
#include <algorithm>
#include <utility>
#include "filter/image/DeadBeams.h"
#include "filter/image/GapRepair.h"
#include "filter/simd/CanopyLayer.h"

#include "filter/FilterStages.h"

namespace hagen {
namespace {

constexpr std::int32_t kBeside = 5;     // columns added on both sides, for the regions
constexpr std::int32_t kTogether = 16;  // number of columns is a multiple of this
constexpr std::size_t kPlaneEvery = 2;  // uses every 2nd of the evenly spaced columns

struct Columns {
    Eigen::Index first = 0, count = 0;
};

/// Copies columns of an image and appends an empty column, because the first and last copied
/// columns are not neighbours although columns wrap around.
template <class Value>
void copyColumns(const Image<Value>& from, Eigen::Index first, Eigen::Index count, Value empty,
                 Image<Value>& to) {
    to.resize(from.rows(), count + 1);
    to.leftCols(count) = from.middleCols(first, count);
    to.rightCols(1).setConstant(empty);
}

void copyColumns(const PixelPoints& from, Eigen::Index first, Eigen::Index count, PixelPoints& to) {
    copyColumns(from.x_m, first, count, kNoValue, to.x_m);
    copyColumns(from.y_m, first, count, kNoValue, to.y_m);
    copyColumns(from.z_m, first, count, kNoValue, to.z_m);
}

void copyColumns(const PixelDirections& from, Eigen::Index first, Eigen::Index count,
                 PixelDirections& to) {
    to.row_sine = from.row_sine;
    to.row_cosine = from.row_cosine;
    const auto copy = [&](const std::vector<float>& values, std::vector<float>& copied) {
        copied.assign(values.begin() + first, values.begin() + first + count);
        copied.push_back(copied.back());  // for the empty column
    };
    copy(from.column_sine, to.column_sine);
    copy(from.column_cosine, to.column_cosine);
}

/// Looks up each pixel's context by its closest return, unless the return belongs to the sector.
void readContext(const RangeImage& image, const SectorOfInterest& sector, Image<Label>& labels,
                 Image<float>& known_m) {
    labels.resize(image.depth_m.rows(), image.depth_m.cols());
    known_m.resize(labels.rows(), labels.cols());
    const std::int32_t* const closest = image.closest_return.data();
    const auto of_sector = static_cast<std::int32_t>(sector.returns.size());
    for (Eigen::Index pixel = 0; pixel < labels.size(); ++pixel) {
        const bool is_known = closest[pixel] >= of_sector;
        const ContextReturn known = is_known ? sector.context[closest[pixel]] : ContextReturn();
        labels.data()[pixel] = known.region;
        known_m.data()[pixel] = known.cell_height_m;
    }
}

/// The cells of the judged pixels in the zone, and the surrounding cells that affect their
/// tolerance.
CellArea areaOf(const Ground& ground, const Columns& judged, const Options& options) {
    constexpr float kBeyond_m = 1;  // beyond the zone, for neighbours of pixels at its edge
    constexpr int kSides = 1;       // margin in cells, for tall neighbours
    const float max_m = options.zone_m + kBeyond_m;
    const Eigen::Index rows = ground.cells.cell.rows();
    CellArea area{CellArea::kSide, 0, CellArea::kSide, 0};
    for (Eigen::Index k = judged.first * rows; k < (judged.first + judged.count) * rows; ++k) {
        const float x_m = ground.pixels.x_m.data()[k], y_m = ground.pixels.y_m.data()[k];
        if (!(x_m * x_m + y_m * y_m < max_m * max_m)) continue;  // true if empty
        const int cell = ground.cells.cell.data()[k];
        const int row = cell % CellArea::kSide, column = cell / CellArea::kSide;
        area.first_row = std::min(area.first_row, row);
        area.end_row = std::max(area.end_row, row + 1);
        area.first_column = std::min(area.first_column, column);
        area.end_column = std::max(area.end_column, column + 1);
    }
    if (area.end_row == 0) return {0, 0, 0, 0};
    return area.grownBy(options.canopy_layer ? kCanopyReach : kSides);
}

}  // namespace

struct SectorFilter::State {
    SensorModel sensor;
    Options options;
    PixelDirections turn;             ///< all columns of a turn
    PixelDirections directions;       ///< columns of the image
    PixelDirections near_directions;  ///< judged columns
    SegmentationResult result;
    Columns judged;           ///< in the images of `result`
    SegmentationResult near;  ///< results for the judged columns and an empty column
    std::vector<ContextReturn> found;
    Image<float> known_m;  ///< known height of each pixel's cell
    std::vector<std::int32_t> plane_columns;
    FilterWorkspace work;

    Columns judgedColumns(const SectorOfInterest& sector) const;
    void project(const Scan& scan, const SectorOfInterest& sector);
    void findRegions(const SectorOfInterest& sector, const std::optional<Attitude>& horizon);
    void findGround(const Scan& scan, const SectorOfInterest& sector,
                    const std::optional<Attitude>& horizon);
    void keepHeights();
    void labelSector(const SectorOfInterest& sector, const std::optional<Attitude>& horizon);
};

SectorFilter::SectorFilter(const SensorModel& sensor, const Options& options)
    : state_(std::make_unique<State>()) {
    checkOptions(options, sensor.rows());
    state_->sensor = sensor;
    state_->options = options;
    state_->turn = pixelDirections(sensor, options.columns);
}

SectorFilter::SectorFilter(SectorFilter&&) noexcept = default;
SectorFilter& SectorFilter::operator=(SectorFilter&&) noexcept = default;
SectorFilter::~SectorFilter() = default;

const std::vector<ContextReturn>& SectorFilter::found() const { return state_->found; }

const SegmentationResult& SectorFilter::segment(const Scan& scan,
                                                const std::optional<Attitude>& attitude,
                                                const SectorOfInterest& sector) {
    State& s = *state_;
    const std::optional<Attitude> horizon = s.options.level_by_attitude ? attitude : std::nullopt;
    s.project(scan, sector);
    s.findRegions(sector, horizon);
    if (usesGround(s.options)) s.findGround(scan, sector, horizon);
    s.keepHeights();
    s.labelSector(sector, horizon);
    return s.result;
}

/// The columns with returns of the sector, and some on both sides.
Columns SectorFilter::State::judgedColumns(const SectorOfInterest& sector) const {
    const RangeImage& image = result.range_image;
    const auto rows = static_cast<std::int32_t>(image.depth_m.rows());
    const auto columns = static_cast<std::int32_t>(image.depth_m.cols());
    std::int32_t first = rows * columns, last = -1;  // pixel indices, column by column
    for (std::size_t i = 0; i < sector.returns.size(); ++i) {
        const std::int32_t pixel = image.depth_mapper[i];
        if (pixel == RangeImage::kNoPixel) continue;
        first = std::min(first, pixel);
        last = std::max(last, pixel);
    }
    if (last < 0) return {0, 1};
    first = std::max(first / rows - kBeside, 0);
    const std::int32_t wanted = last / rows + kBeside - first + 1;
    const std::int32_t rounded = (wanted + kTogether - 1) / kTogether * kTogether;
    return {first, std::min(rounded, columns - first)};
}

/// Stages 1 and 2. Repairs gaps only in the judged columns, but finds dead beams in the whole turn.
void SectorFilter::State::project(const Scan& scan, const SectorOfInterest& sector) {
    const Options& o = options;
    SegmentationResult& r = result;
    const Image<float>& depth_m = r.range_image.depth_m;
    projectScan(scan, sensor, sector.columns, std::max(o.context_m, o.zone_m), r.range_image,
                work.projection);
    if (o.window_fills_gaps && sector.latest < scan.size())
        preferFirst(scan, sector.latest, r.range_image);
    mapDirections(turn, sector.columns, directions);
    judged = judgedColumns(sector);
    const auto [first, count] = judged;
    copyColumns(directions, first, count, near_directions);
    copyColumns(depth_m, first, count, kNoValue, near.range_image.depth_m);
    repairGaps(near.range_image.depth_m, o.repair_max_step_m, near.repaired_m);
    if (o.bridge_dead_beams)
        bridgeDeadBeams(depth_m, near_directions, near.repaired_m, work.dead_beams);
    r.repaired_m = depth_m;
    r.repaired_m.middleCols(first, count) = near.repaired_m.leftCols(count);
}

/// Runs stages 3 to 8 on the judged columns; `result.labels` are the regions of all columns.
void SectorFilter::State::findRegions(const SectorOfInterest& sector,
                                      const std::optional<Attitude>& horizon) {
    SegmentationResult& r = result;
    labelByAngles(near_directions, sensor.min_range_m, horizon, options, near, work);
    readContext(r.range_image, sector, r.labels, known_m);
    r.labels.middleCols(judged.first, judged.count) = near.labels.leftCols(judged.count);

    found.assign(sector.returns.size(), {});
    for (std::size_t i = 0; i < found.size(); ++i) {
        const std::int32_t pixel = r.range_image.depth_mapper[i];
        if (pixel != RangeImage::kNoPixel) found[i].region = r.labels.data()[pixel];
    }
}

/// Finds the ground under all columns of the map.
void SectorFilter::State::findGround(const Scan& scan, const SectorOfInterest& sector,
                                     const std::optional<Attitude>& horizon) {
    const std::vector<std::int32_t>& even = sector.columns.even;
    plane_columns.clear();
    for (std::size_t k = 0; k < even.size(); k += kPlaneEvery) plane_columns.push_back(even[k]);
    Ground& g = result.ground;
    findGroundPlane(scan, directions, horizon, options, &plane_columns, kNoLimit_m, result, work);
    if (!g.has_surface) return;
    findGroundSurface(result.labels, options, &even, g, work);
    const CellArea area = areaOf(g, judged, options);
    findCellTops(g.cells, g.height_m, g.tops, area);
    raiseHighest(g.cells, known_m, g.tops);
    findTolerances(options, area, g, work);
}

/// Stores the cell heights of the sector's returns now that the cells contain all of these returns.
void SectorFilter::State::keepHeights() {
    const Ground& ground = result.ground;
    if (!ground.has_surface) return;
    for (std::size_t i = 0; i < found.size(); ++i) {
        const std::int32_t pixel = result.range_image.depth_mapper[i];
        if (pixel == RangeImage::kNoPixel) continue;
        found[i].cell_height_m = highestOf(ground.tops, ground.cells.cell.data()[pixel]);
    }
}

/// Runs the stages after the ground on the judged columns, then stage 9.
void SectorFilter::State::labelSector(const SectorOfInterest& sector,
                                      const std::optional<Attitude>& horizon) {
    const Options& o = options;
    SegmentationResult& r = result;
    const Ground& g = r.ground;
    const auto [first, count] = judged;
    Ground& own = near.ground;
    own.is_seen = g.is_seen;
    own.has_surface = g.has_surface;
    if (g.has_surface) {
        copyColumns(g.pixels, first, count, own.pixels);
        copyColumns(g.height_m, first, count, kNoValue, own.height_m);
        copyColumns(g.tolerance_m, first, count, kNoValue, own.tolerance_m);
    }
    relabelByGround(own, o, near.labels, work);
    if (o.context_m > o.zone_m) limitToZone(near.repaired_m, o.zone_m, near.labels);
    r.labels.setConstant(Label::Unclassified);
    r.labels.middleCols(first, count) = near.labels.leftCols(count);
    r.own_labels.label.clear();
    r.own_labels.returns.clear();
    if (usesGround(o)) judgeClearance(sector.returns, horizon, o, r, work);
    extractReturns(sector.returns, r.range_image, r.labels, r.own_labels, o.zone_m, r.returns,
                   work.extraction);
}

}  // namespace hagen
