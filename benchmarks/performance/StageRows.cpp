#include "StageRows.h"

#include <hagen/mrpt/VelodyneObservation.h>
#include <hagen/scan/Angle.h>
#include <hagen/settings/Settings.h>
#include "evaluation/baselines/BaselineZermas.h"
#include "filter/FilterStages.h"
#include "filter/RoiBoxes.h"
#include "filter/image/GapRepair.h"
#include "filter/paper/RangeAngle.h"
#include "filter/paper/Sharpening.h"
#include "filter/simd/CanopyLayer.h"

#include "filter/FilterWorkspace.h"

namespace hagen {
namespace {

/// Buffers of individually timed stages, shared by all scans as in a filter.
FilterWorkspace& work() {
    static FilterWorkspace kept;
    return kept;
}

float radiansf(float angle_deg) { return static_cast<float>(radians(angle_deg)); }

/// Computes beams, azimuths and ranges from the sensor's data.
void readReturns(Case& c) {
    if (!c.input->packets.empty()) {
        static observations::ObservationWorkspace decoder;
        observations::decodePackets(*c.packets, c.scan, decoder);
    } else {
        locateBeams(c.input->model, c.scan);
    }
}

void wholePipeline(Case& c) {
    readReturns(c);
    c.filter.segment(c.scan);
}

void zermas(Case& c) {
    readReturns(c);
    evaluation::zermasGroundFit(c.scan, c.input->model);
}

Options withColumns(Options options, int columns) {
    options.columns = columns;
    return options;
}

std::vector<StageRow> papersStages() {
    return {{"decode", readReturns},
            {"1 depth image",
             [](Case& c) {
                 projectScan(c.scan, c.input->model, c.options.columns, c.options.context_m,
                             c.result.range_image, work().projection);
             }},
            {"2 gap repair",
             [](Case& c) { repairGaps(c.result.range_image.depth_m, 1.0f, c.result.sharpened_m); }},
            {"3 local maxima",
             [](Case& c) {
                 proximityOf(c.result.repaired_m, c.options.zone_m, c.result.proximity_m);
                 findPersistentMaxima(c.result.proximity_m, c.options.persistence_m,
                                      c.result.maxima, work().maxima);
             }},
            {"4+5 sharpening and merge",
             [](Case& c) {
                 sharpenMaxima(c.result.proximity_m, c.result.maxima, c.options.sharpening_sigma_px,
                               c.options.sharpening_sigma_m, c.result.sharpened_m);
                 mergeMaxima(c.result.repaired_m, c.result.proximity_m, c.result.sharpened_m,
                             c.result.maxima, c.input->model.min_range_m, c.result.merged_m);
             }},
            {"6 range angles",
             [](Case& c) {
                 rangeAngles(c.result.merged_m, c.directions, c.result.range_angle_rad);
                 carryAngles(c.result.smoothed_rad, c.result.pixel_angle_rad);
             }},
            {"7 singular spectrum analysis",
             [](Case& c) {
                 smoothColumns(c.result.range_angle_rad, c.options.window_size,
                               c.options.principal_components, c.result.smoothed_rad, work().ssa);
             }},
            {"8 labelling",
             [](Case& c) {
                 labelRegions(c.result.repaired_m, c.result.pixel_angle_rad,
                              radiansf(c.options.beta_deg), c.options.seeds,
                              radiansf(c.options.seed_gate_deg), c.result.labels, work().labelling);
                 limitToZone(c.result.repaired_m, c.options.zone_m, c.result.labels);
             }},
            {"9 extraction", [](Case& c) {
                 extractReturns(c.scan, c.result.range_image, c.result.labels, c.result.own_labels,
                                c.options.zone_m, c.result.returns, work().extraction);
             }}};
}

float heightAboveGround_m(const Ground& ground) {
    return ground.from_sensor.translation().z() - ground.surface.at(0, 0);
}

std::vector<StageRow> ownStages() {
    return {
        {"dead beams",
         [](Case& c) {
             bridgeDeadBeams(c.result.range_image.depth_m, c.directions, c.result.repaired_m,
                             work().dead_beams);
         }},
        {"ground frame",
         [](Case& c) {
             static PixelPoints pixels;
             locatePixels(c.scan, c.directions, c.result.range_image, c.result.repaired_m, pixels);
             movePixels(fitGroundFrame(pixels, Attitude{}, work().ground_frame), pixels);
         }},
        {"ground surface",
         [](Case& c) {
             static GroundSurface surface;
             fitGroundSurface(c.result.ground.pixels, c.result.labels, surface,
                              work().ground_surface);
         }},
        {"heights and tolerances",
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
        {"canopy",
         [](Case& c) {
             Ground& g = c.result.ground;
             tolerateCanopy(g.cells, g.tops, heightAboveGround_m(g), g.tolerance_m);
         }},
        {"evidence of ground",
         [](Case& c) {
             Ground& g = c.result.ground;
             findPixelCells(g.pixels, g.cells);
             findLevelPixels(g.pixels, g.cells, g.is_level, work().evidence);
             keepLevelRou(c.result.labels, g.is_level, work().candidates);
             requireEvidence(g.pixels, g.cells, g.height_m, g.is_level, heightAboveGround_m(g),
                             g.tolerance_m, g.has_evidence);
         }},
        {"labels, feet, specks",
         [](Case& c) {
             const Ground& g = c.result.ground;
             labelByHeight(g.height_m, g.tolerance_m, c.result.labels);
             growFeet(g.pixels, g.height_m, c.result.labels, work().feet);
             removeSpecks(g.pixels, g.height_m, g.tolerance_m, c.result.labels, work().specks);
             limitToZone(c.result.repaired_m, c.options.zone_m, c.result.labels);
         }},
        {"farther returns",
         [](Case& c) {
             const Clearance clearance{Eigen::Vector3f::UnitZ(), c.options.ground_is_roi_below_m};
             judgeFartherReturns(c.scan, c.result.range_image, c.result.ground, clearance,
                                 c.options.zone_m, c.result.own_labels, work().farther_returns);
         }},
        {"obstacles numbered (on demand)",
         [](Case& c) { numberObstacles(c.scan, c.options, c.result, work()); }},
        {"boxes (on demand)", [](Case& c) { boxRoiComponents(c.scan, c.result.returns); }}};
}

}  // namespace

Options paperOptions() {
    Settings settings;
    mergeSettings(HAGEN_SOURCE_DIR "/config/paper.yaml", settings);
    return settings.options;
}

Options fastOptions() {
    Options options;
    options.raw_angles = true;
    return options;
}

Case::Case(const Input& from, const Options& with)
    : input(&from),
      packets(mrpt::obs::CObservationVelodyneScan::Create()),
      options(withColumns(with, from.columns)),
      directions(pixelDirections(from.model, from.columns)),
      filter(from.model, options) {}

void Case::load(std::size_t which) {
    if (input->packets.empty()) {
        scan = input->points[which];
    } else {
        *packets = *input->packets[which];
    }
}

void Case::loadResults(std::size_t which) {
    load(which);
    readReturns(*this);
    result = filter.segment(scan);
}

std::vector<StageGroup> pipelines() {
    return {{Options(), {{kMrptDecode, [](Case& c) { c.packets->generatePointCloud(); }}}},
            {paperOptions(), {{kPaperPipeline, wholePipeline}}},
            {Options(), {{kDefaultPipeline, wholePipeline}}},
            {fastOptions(), {{kFastPipeline, wholePipeline}}},
            {Options(), {{"zermas", zermas}}}};
}

std::vector<StageGroup> stages() {
    Options papers = paperOptions(), ours;
    papers.number_obstacles = ours.number_obstacles = true;
    return {{papers, papersStages()}, {ours, ownStages()}};
}

}  // namespace hagen
