#pragma once
#include <hagen/filter/Levelling.h>
#include <hagen/filter/Options.h>
#include <hagen/filter/SegmentationResult.h>
#include <hagen/scan/ColumnMap.h>
#include <hagen/scan/Image.h>
#include <hagen/scan/Label.h>
#include <hagen/scan/Scan.h>
#include <hagen/scan/SensorModel.h>
#include <cstddef>
#include <limits>
#include <memory>
#include <optional>
#include <vector>

namespace hagen {

/// The result for a return of a sector, kept as context for later sectors.
struct ContextReturn {
    Label region = Label::Unclassified;  ///< its pixel's label from the paper's stages
    /// Height of the highest return in its ground cell (CellTops.h); NaN if unknown. Later sectors
    /// contain only a few returns of that cell.
    float cell_height_m = kNoValue;
};

/// A sector of a turn, with context that shows where the ground is.
struct SectorOfInterest {
    const Scan& returns;       ///< to be labelled: the first returns of the scan
    const ColumnMap& columns;  ///< of the image: dense around the sector, sparse elsewhere
    /// For each return of the scan, SectorFilter::found() from its own sector; entries of `returns`
    /// are not read.
    const std::vector<ContextReturn>& context;
    /// Returns of the latest turn, which come first. Those of older turns (SlidingWindow.h) follow.
    std::size_t latest = std::numeric_limits<std::size_t>::max();
};

/// The stages of HagenFilter for a part of a turn. Stages 3 to 8, which compare neighbouring
/// pixels, run on the columns of the sector and a few columns on both sides; other returns keep the
/// region from their own sector. The ground is fitted under all columns, but only the sector is
/// relabelled. Nearly all labels equal HagenFilter's labels of the whole scan. A canopy is detected
/// from the cell heights of the context in its own sectors. Obstacles are not numbered.
class SectorFilter {
 public:
    /// Throws like HagenFilter.
    SectorFilter(const SensorModel& sensor, const Options& options);
    SectorFilter(SectorFilter&& other) noexcept;
    SectorFilter& operator=(SectorFilter&& other) noexcept;
    ~SectorFilter();

    /// Labels the sector's returns. Requires an upright sensor (postureOf()). The result's images
    /// have the columns of the map, but labels only in the sector; results of stages 3 to 7 are not
    /// included. The result is valid until the next call. Throws std::invalid_argument like
    /// HagenFilter::segment().
    const SegmentationResult& segment(const Scan& scan, const std::optional<Attitude>& attitude,
                                      const SectorOfInterest& sector);

    /// For each return of the sector, its future entry in `SectorOfInterest::context`.
    const std::vector<ContextReturn>& found() const;

 private:
    struct State;  ///< the result and all buffers
    std::unique_ptr<State> state_;
};

}  // namespace hagen
