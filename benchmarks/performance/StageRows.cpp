#include "StageRows.h"

#include <hagen/mrpt/VelodyneObservation.h>
#include <hagen/scan/Angle.h>
#include <hagen/settings/Settings.h>
#include "evaluation/baselines/BaselineZermas.h"
#include "filter/RoiBoxes.h"
#include "filter/image/GapRepair.h"
#include "filter/paper/RangeAngle.h"
#include "filter/paper/Sharpening.h"
#include "filter/simd/CanopyLayer.h"

#include <algorithm>
#include <cstring>

#include "filter/FilterWorkspace.h"

namespace hagen {
namespace {

/// Buffers of individually timed stages, shared by all scans as in a filter.
FilterWorkspace& work() {
    static FilterWorkspace kept;
    return kept;
}

float radiansf(float angle_deg) { return static_cast<float>(radians(angle_deg)); }

/// Sums `bytes` bytes, eight at a time, at memory bandwidth.
std::uint64_t readAll(const void* memory, std::size_t bytes) {
    std::uint64_t sum = 0, word;
    const auto* at = static_cast<const char*>(memory);
    for (std::size_t i = 0; i + sizeof word <= bytes; i += sizeof word) {
        std::memcpy(&word, at + i, sizeof word);
        sum += word;
    }
    return sum;
}

void floorOf(Case& c) {
    std::uint64_t sum = 0;
    if (c.packets) {
        const auto& packets = c.packets->scan_packets;
        sum = readAll(packets.data(), packets.size() * sizeof packets.front());
    } else {
        for (const auto* values : {&c.scan.x_m, &c.scan.y_m, &c.scan.z_m}) {
            sum += readAll(values->data(), values->size() * sizeof(float));
        }
    }
    c.floor_labels.resize(c.scan.size());
    std::fill(c.floor_labels.begin(), c.floor_labels.end(), sum % 2 == 0 ? Label::Roi : Label::Rou);
}

void wholePipeline(Case& c) {
    readReturns(c);
    c.filter.segment(c.scan);
}

const std::vector<StageRow>& papersStages() {
    static const std::vector<StageRow> rows{
        {"decode", true, false, readReturns},
        {"1 depth image", true, false,
         [](Case& c) {
             projectScan(c.scan, c.sensor, c.options.columns, c.options.context_m,
                         c.result.range_image, work().projection);
         }},
        {"2 gap repair", true, false,
         [](Case& c) { repairGaps(c.result.range_image.depth_m, 1.0f, c.result.sharpened_m); }},
        {"3 local maxima", true, false,
         [](Case& c) {
             proximityOf(c.result.repaired_m, c.options.zone_m, c.result.proximity_m);
             findPersistentMaxima(c.result.proximity_m, c.options.persistence_m, c.result.maxima,
                                  work().maxima);
         }},
        {"4+5 sharpening and merge", true, false,
         [](Case& c) {
             sharpenMaxima(c.result.proximity_m, c.result.maxima, c.options.sharpening_sigma_px,
                           c.options.sharpening_sigma_m, c.result.sharpened_m);
             mergeMaxima(c.result.repaired_m, c.result.proximity_m, c.result.sharpened_m,
                         c.result.maxima, c.sensor.min_range_m, c.result.merged_m);
         }},
        {"6 range angles", true, false,
         [](Case& c) {
             rangeAngles(c.result.merged_m, c.directions, c.result.range_angle_rad);
             carryAngles(c.result.smoothed_rad, c.result.pixel_angle_rad);
         }},
        {"7 singular spectrum analysis", true, false,
         [](Case& c) {
             smoothColumns(c.result.range_angle_rad, c.options.window_size,
                           c.options.principal_components, c.result.smoothed_rad, work().ssa);
         }},
        {"8 labelling", true, false,
         [](Case& c) {
             labelRegions(c.result.repaired_m, c.result.pixel_angle_rad,
                          radiansf(c.options.beta_deg), c.options.seeds,
                          radiansf(c.options.seed_gate_deg), c.result.labels, work().labelling);
             limitToZone(c.result.repaired_m, c.options.zone_m, c.result.labels);
         }},
        {"obstacles numbered", true, false,
         [](Case& c) {
             numberRoiComponents(c.result.repaired_m, c.result.labels, c.options.component_gap_m,
                                 c.result.components, work().components);
         }},
        {"9 extraction", true, false, [](Case& c) {
             extractReturns(c.scan, {c.result.range_image, c.result.labels, c.result.components},
                            c.result.own_labels, {c.options.zone_m, c.options.component_gap_m},
                            c.result.returns, work().extraction);
         }}};
    return rows;
}

const std::vector<StageRow>& ownStages() {
    static const std::vector<StageRow> rows{
        {"own: ground frame", false, false,
         [](Case& c) {
             static PixelPoints pixels;
             locatePixels(c.scan, c.directions, c.result.range_image, c.result.repaired_m, pixels);
             movePixels(fitGroundFrame(pixels, Attitude{}, work().ground_frame), pixels);
         }},
        {"own: evidence of ground", false, false,
         [](Case& c) {
             static Image<std::uint8_t> is_level;
             static Image<float> tolerance_m;
             Ground& g = c.result.ground;
             findPixelCells(g.pixels, g.cells);
             findLevelPixels(g.pixels, g.cells, is_level, work().evidence);
             keepLevelRou(c.result.labels, is_level, work().candidates);
             tolerance_m = g.tolerance_m;
             requireEvidence(g.pixels, g.cells, g.height_m, is_level,
                             g.from_sensor.translation().z(), tolerance_m, g.has_evidence,
                             work().evidence);
         }},
        {"own: ground surface", false, false,
         [](Case& c) {
             static GroundSurface surface;
             fitGroundSurface(c.result.ground.pixels, c.result.labels, surface,
                              work().ground_surface);
         }},
        {"own: heights and tolerances", false, false,
         [](Case& c) {
             const Options& o = c.options;
             Ground& g = c.result.ground;
             heightsAbove(g.surface, g.pixels, g.height_m);
             findCellTops(g.cells, g.height_m, g.tops);
             toleratedHeights(
                 g.pixels, g.cells, g.tops,
                 {o.ground_tolerance_m, o.ground_tolerance_per_m, o.ground_tolerance_beside_tall},
                 g.from_sensor.translation().z(), g.tolerance_m, work().tolerance);
         }},
        {"own: canopy", false, false,
         [](Case& c) {
             Ground& g = c.result.ground;
             tolerateCanopy(g.cells, g.tops, g.from_sensor.translation().z(), g.tolerance_m);
         }},
        {"own: labels, feet, specks", false, false,
         [](Case& c) {
             const Ground& g = c.result.ground;
             labelByHeight(g.height_m, g.tolerance_m, c.result.labels);
             growFeet(g.pixels, g.height_m, c.result.labels, work().feet);
             removeSpecks(g.pixels, g.height_m, g.tolerance_m, c.result.labels, work().specks);
         }},
        {"own: farther returns", false, false,
         [](Case& c) {
             const Clearance clearance{Eigen::Vector3f::UnitZ(), c.options.ground_is_roi_below_m};
             judgeFartherReturns(c.scan, c.result.range_image, c.result.ground, clearance,
                                 c.options.zone_m, c.result.own_labels, work().farther_returns);
         }},
        {"boxes (on demand)", false, false,
         [](Case& c) { boxRoiComponents(c.scan, c.result.returns); }}};
    return rows;
}

}  // namespace

Options paperOptions() {
    Settings settings;
    mergeSettings(HAGEN_SOURCE_DIR "/config/paper.yaml", settings);
    return settings.options;
}

Case::Case(const Input& input, std::size_t which, const Options& with)
    : packets(input.packets.empty() ? nullptr : input.packets[which]),
      sensor(input.model),
      options(with),
      directions(pixelDirections(sensor, options.columns)),
      filter(sensor, options) {
    if (!packets) scan = input.points[which];
    readReturns(*this);
    result = filter.segment(scan);
}

void readReturns(Case& one) {
    if (one.packets) {
        static observations::ObservationWorkspace decoder;
        observations::decodePackets(*one.packets, one.scan, decoder);
    } else {
        locateBeams(one.sensor, one.scan);
    }
}

const std::vector<StageRow>& stageRows() {
    static const std::vector<StageRow> rows = [] {
        std::vector<StageRow> all{
            {"floor", true, false, floorOf},
            {"mrpt decode", true, true, [](Case& c) { c.packets->generatePointCloud(); }},
            {"paper pipeline", true, false, wholePipeline},
            {"default pipeline", false, false, wholePipeline},
            {"zermas ground fit", true, false,
             [](Case& c) { evaluation::zermasGroundFit(c.scan, c.sensor); }}};
        all.insert(all.end(), papersStages().begin(), papersStages().end());
        all.insert(all.end(), ownStages().begin(), ownStages().end());
        return all;
    }();
    return rows;
}

}  // namespace hagen
