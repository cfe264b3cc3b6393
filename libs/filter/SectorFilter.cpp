#include <hagen/filter/Clearance.h>
#include <hagen/filter/DeadBeams.h>
#include <hagen/filter/GapRepair.h>
#include <hagen/filter/SectorFilter.h>
#include <algorithm>
#include <utility>

#include "filter/FilterStages.h"

namespace hagen {
namespace {

constexpr std::int32_t kBeside = 5;     // columns on both sides of a sector, for its regions
constexpr std::int32_t kTogether = 16;  // columns; so that most sectors need images of one size
constexpr std::size_t kPlaneEvery = 2;  // of the columns that are spread over the turn

/// Some columns of an image, and an empty one, which keeps the last from the first: they are no
/// neighbours, though columns wrap around.
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
        copied.push_back(copied.back());  // of the empty column
    };
    copy(from.column_sine, to.column_sine);
    copy(from.column_cosine, to.column_cosine);
}

/// What is known of each pixel by its closest return, unless that is of the sector.
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

}  // namespace

SectorFilter::SectorFilter(const SensorModel& sensor, const Options& options)
    : sensor_(sensor), options_(options), turn_(pixelDirections(sensor, options.columns)) {
    checkOptions(options_, sensor_.rows());
}

const SegmentationResult& SectorFilter::segment(const Scan& scan,
                                                const std::optional<Attitude>& attitude,
                                                const SectorOfInterest& sector) {
    const std::optional<Attitude> horizon = options_.level_by_attitude ? attitude : std::nullopt;
    project(scan, sector);
    findRegions(sector, horizon);
    if (options_.ground_surface || options_.ground_is_roi_below_m > 0) {
        const std::vector<std::int32_t>& even = sector.columns.even;
        plane_columns_.clear();
        for (std::size_t k = 0; k < even.size(); k += kPlaneEvery) {
            plane_columns_.push_back(even[k]);
        }
        const JudgedPart part{judged_.first, judged_.count, plane_columns_, even, known_m_};
        findGround(scan, directions_, result_, horizon, options_, &part, result_.ground, work_);
    }
    keepHeights();
    labelSector(sector, horizon);
    return result_;
}

/// All that have returns of the sector, and some beside it.
SectorFilter::Columns SectorFilter::judgedColumns(const SectorOfInterest& sector) const {
    const RangeImage& image = result_.range_image;
    const auto rows = static_cast<std::int32_t>(image.depth_m.rows());
    const auto columns = static_cast<std::int32_t>(image.depth_m.cols());
    std::int32_t first = rows * columns, last = -1;  // pixels, column by column
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

/// Stages 1 and 2. Gaps are repaired where the pixels are judged; which beams are dead, the whole
/// turn tells.
void SectorFilter::project(const Scan& scan, const SectorOfInterest& sector) {
    const Options& o = options_;
    SegmentationResult& r = result_;
    const Image<float>& depth_m = r.range_image.depth_m;
    projectScan(scan, sensor_, sector.columns, std::max(o.context_m, o.zone_m), r.range_image,
                work_.projection);
    mapDirections(turn_, sector.columns, directions_);
    judged_ = judgedColumns(sector);
    const auto [first, count] = judged_;
    copyColumns(directions_, first, count, near_directions_);
    copyColumns(depth_m, first, count, kNoValue, near_.range_image.depth_m);
    repairGaps(near_.range_image.depth_m, o.repair_max_step_m, near_.repaired_m);
    if (o.bridge_dead_beams)
        bridgeDeadBeams(depth_m, near_directions_, near_.repaired_m, work_.dead_beams);
    r.repaired_m = depth_m;
    r.repaired_m.middleCols(first, count) = near_.repaired_m.leftCols(count);
}

/// Stages 3 to 8 for the columns that are judged; `result_.labels` are the regions of all.
void SectorFilter::findRegions(const SectorOfInterest& sector,
                               const std::optional<Attitude>& horizon) {
    SegmentationResult& r = result_;
    labelByAngles(near_.repaired_m, near_directions_, sensor_.min_range_m, horizon, options_, near_,
                  work_);
    readContext(r.range_image, sector, r.labels, known_m_);
    r.labels.middleCols(judged_.first, judged_.count) = near_.labels.leftCols(judged_.count);

    found_.assign(sector.returns.size(), {});
    for (std::size_t i = 0; i < found_.size(); ++i) {
        const std::int32_t pixel = r.range_image.depth_mapper[i];
        if (pixel != RangeImage::kNoPixel) found_[i].region = r.labels.data()[pixel];
    }
}

/// How high the cells of the sector's returns are, now that all of its returns are in them.
void SectorFilter::keepHeights() {
    const Ground& ground = result_.ground;
    if (!ground.has_surface) return;
    for (std::size_t i = 0; i < found_.size(); ++i) {
        const std::int32_t pixel = result_.range_image.depth_mapper[i];
        if (pixel == RangeImage::kNoPixel) continue;
        found_[i].cell_height_m = highestOf(ground.tops, ground.cells.cell.data()[pixel]);
    }
}

/// What follows the ground, for the columns that are judged, and stage 9.
void SectorFilter::labelSector(const SectorOfInterest& sector,
                               const std::optional<Attitude>& horizon) {
    const Options& o = options_;
    SegmentationResult& r = result_;
    const Ground& g = r.ground;
    const auto [first, count] = judged_;
    if (g.has_surface) {
        Ground& near = near_.ground;
        copyColumns(g.pixels, first, count, near.pixels);
        copyColumns(g.height_m, first, count, kNoValue, near.height_m);
        copyColumns(g.tolerance_m, first, count, kNoValue, near.tolerance_m);
        relabelByHeight(near.pixels, near.height_m, near.tolerance_m, o, near_.labels, work_);
    }
    if (o.ground_surface && o.ground_evidence && !g.is_seen) doubtAll(near_.labels);
    if (o.context_m > o.zone_m) limitToZone(near_.repaired_m, o.zone_m, near_.labels);
    r.labels.setConstant(Label::Unclassified);
    r.labels.middleCols(first, count) = near_.labels.leftCols(count);
    r.own_labels.label.clear();
    r.own_labels.returns.clear();
    if (o.ground_surface || o.ground_is_roi_below_m > 0) {
        const Clearance clearance{upwards(g, horizon), o.ground_is_roi_below_m};
        alarmLowGround(g, clearance, r.labels);
        judgeFartherReturns(sector.returns, r.range_image, g, clearance, o.zone_m, r.own_labels,
                            work_.farther_returns);
    }
    r.components.setZero(r.labels.rows(), r.labels.cols());
    extractReturns(sector.returns, {r.range_image, r.labels, r.components}, r.own_labels,
                   {o.zone_m, o.component_gap_m}, r.returns, work_.extraction);
}

}  // namespace hagen
