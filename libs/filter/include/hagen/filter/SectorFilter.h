#pragma once
#include <hagen/filter/Levelling.h>
#include <hagen/filter/Options.h>
#include <hagen/filter/SegmentationResult.h>
#include <hagen/scan/ColumnMap.h>
#include <hagen/scan/Image.h>
#include <hagen/scan/Label.h>
#include <hagen/scan/Scan.h>
#include <hagen/scan/SensorModel.h>
#include <memory>
#include <optional>
#include <vector>

namespace hagen {

/// The result for a return of a sector, kept for later sectors that have it as context.
struct ContextReturn {
    Label region = Label::Unclassified;  ///< of its pixel, by the stages of the paper
    /// The highest return of its ground cell, above the surface (CellTops.h); NaN: not known. Later
    /// sectors have few of the returns of that cell.
    float cell_height_m = kNoValue;
};

/// A sector of a turn among its context, which shows where the ground is.
struct SectorOfInterest {
    const Scan& returns;       ///< of the sector: the first ones of the scan, which get labels
    const ColumnMap& columns;  ///< of the image: all in and beside the sector, fewer elsewhere
    /// Per return of the scan: what was found of it (SectorFilter::found()) when it was in a sector
    /// itself; those of `returns` are not read.
    const std::vector<ContextReturn>& context;
};

/// The stages of HagenFilter for a part of a turn. Stages 3 to 8, which compare a pixel with its
/// neighbours, run on the columns of the sector and a few beside it; other returns keep the region
/// that they got there. The ground is found under all of them, and only the sector is labelled by
/// it: its labels are those of a whole scan but for a few. A canopy is recognised by
/// how high the cells of the context were in their own sectors. Obstacles are not numbered.
class SectorFilter {
 public:
    /// As HagenFilter.
    SectorFilter(const SensorModel& sensor, const Options& options);
    SectorFilter(SectorFilter&& other) noexcept;
    SectorFilter& operator=(SectorFilter&& other) noexcept;
    ~SectorFilter();

    /// Labels the sector's returns. For a sensor that is upright (postureOf()). The images of the
    /// result have the columns of the map, and labels in those of the sector; what stages 3 to 7
    /// found is not in it. The result is valid until the next call. Throws std::invalid_argument as
    /// HagenFilter::segment().
    const SegmentationResult& segment(const Scan& scan, const std::optional<Attitude>& attitude,
                                      const SectorOfInterest& sector);

    /// Per return of the sector, what `SectorOfInterest::context` needs once it is context.
    const std::vector<ContextReturn>& found() const;

 private:
    struct State;  ///< the result and all buffers
    std::unique_ptr<State> state_;
};

}  // namespace hagen
