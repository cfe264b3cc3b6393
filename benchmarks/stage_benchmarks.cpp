// Times each stage of the published filter, and the whole, on the real VLP-16 scan of mrpt-common;
// beside them, in the same run, MRPT's own decoder, which reads half of that scan. "paper pipeline"
// is the whole, from packets to labels.
#include <benchmark/benchmark.h>
#include <hagen/logs/RawlogReader.h>
#include <hagen/observations/Settings.h>
#include <hagen/observations/VelodyneDecoder.h>
#include <hagen/range_image/Angle.h>
#include <hagen/segmentation/CanopyLayer.h>
#include <hagen/segmentation/FartherReturns.h>
#include <hagen/segmentation/GapRepair.h>
#include <hagen/segmentation/GroundFrame.h>
#include <hagen/segmentation/HagenFilter.h>
#include <hagen/segmentation/HeightLabels.h>
#include <hagen/segmentation/Labelling.h>
#include <hagen/segmentation/RangeAngle.h>
#include <hagen/segmentation/RoiBoxes.h>
#include <hagen/segmentation/RoiComponents.h>
#include <hagen/segmentation/Sharpening.h>
#include <hagen/segmentation/SingularSpectrumAnalysis.h>

#include <iostream>

namespace {

using namespace hagen;
using mrpt::obs::CObservationVelodyneScan;

const char* const kRealScan = "/usr/share/mrpt/datasets/test_velodyne_VLP16.rawlog";

Options paperOptions() {
    Settings settings;
    mergeSettings(HAGEN_SOURCE_DIR "/config/paper.yaml", settings);
    return settings.options;
}

/// The scan, and what each stage made of it: the inputs of the next one.
struct Fixture {
    CObservationVelodyneScan::Ptr observation =
        std::dynamic_pointer_cast<CObservationVelodyneScan>(RawlogReader(kRealScan).next());
    SensorModel sensor = sensorOf(*observation);
    Options options;
    PixelDirections directions = pixelDirections(sensor, options.columns);
    Scan scan;
    HagenFilter filter{sensor, options};
    SegmentationResult result;

    explicit Fixture(const Options& with) : options(with) {
        decodePackets(*observation, scan);
        result = filter.segment(scan);
    }
};

Fixture& papers() {
    static Fixture instance(paperOptions());
    return instance;
}

Fixture& ours() {
    static Fixture instance{Options()};
    return instance;
}

/// Registers one stage: `run` takes the fixture and writes into its own buffers.
template <class Run>
void add(const char* name, Run run, Fixture& (*fixture)() = papers) {
    benchmark::RegisterBenchmark(name, [run, fixture](benchmark::State& state) {
        Fixture& f = fixture();
        for (auto _ : state) {
            run(f);
            benchmark::ClobberMemory();
        }
    })->Unit(benchmark::kMicrosecond);
}

/// The stages beyond the paper.
void addOurs() {
    const auto addOne = [](const char* name, auto run) { add(name, run, ours); };
    addOne("ground frame", [](Fixture& f) {
        PixelPoints pixels;
        locatePixels(f.scan, f.directions, f.result.range_image, f.result.repaired_m, pixels);
        movePixels(fitGroundFrame(pixels, Attitude{}), pixels);
    });
    addOne("ground surface", [](Fixture& f) {
        GroundSurface surface;
        fitGroundSurface(f.result.ground.pixels, f.result.labels, surface);
    });
    addOne("heights and their tolerances", [](Fixture& f) {
        const Options& o = f.options;
        Ground& g = f.result.ground;
        heightsAbove(g.surface, g.pixels, g.height_m);
        findCellTops(g.pixels, g.height_m, g.tops);
        toleratedHeights(
            g.pixels, g.tops,
            {o.ground_tolerance_m, o.ground_tolerance_per_m, o.ground_tolerance_beside_tall},
            g.tolerance_m);
    });
    addOne("canopy", [](Fixture& f) {
        const Ground& g = f.result.ground;
        tolerateCanopy(g.tops, g.height_m, f.result.ground.tolerance_m);
    });
    addOne("labels by height, feet, specks", [](Fixture& f) {
        const Ground& g = f.result.ground;
        labelByHeight(g.height_m, g.tolerance_m, f.result.labels);
        growFeet(g.pixels, g.height_m, f.result.labels);
        removeSpecks(g.pixels, g.height_m, g.tolerance_m, f.result.labels);
    });
    addOne("farther returns", [](Fixture& f) {
        judgeFartherReturns(f.scan, f.result.range_image, f.result.ground, f.result.own_label);
    });
    addOne("boxes", [](Fixture& f) {
        benchmark::DoNotOptimize(boxRoiComponents(f.scan, f.result.returns));
    });
    addOne("default pipeline", [](Fixture& f) {
        decodePackets(*f.observation, f.scan);
        f.filter.segment(f.scan);
    });
}

void addAll() {
    add("mrpt decode", [](Fixture& f) { f.observation->generatePointCloud(); });
    add("decode", [](Fixture& f) { decodePackets(*f.observation, f.scan); });
    add("1 depth image", [](Fixture& f) {
        projectScan(f.scan, f.sensor, f.options.columns, f.options.context_m, f.result.range_image);
    });
    add("2 gap repair",
        [](Fixture& f) { repairGaps(f.result.range_image.depth_m, 1.0f, f.result.sharpened_m); });
    add("3 local maxima", [](Fixture& f) {
        findPersistentMaxima(f.result.proximity_m, f.options.persistence_m, f.result.maxima);
    });
    add("4+5 sharpening and merge", [](Fixture& f) {
        sharpenMaxima(f.result.proximity_m, f.result.maxima, f.options.sharpening_sigma_px,
                      f.options.sharpening_sigma_m, f.result.sharpened_m);
        mergeMaxima(f.result.repaired_m, f.result.proximity_m, f.result.sharpened_m,
                    f.result.maxima, f.sensor.min_range_m, f.result.merged_m);
    });
    add("6 range angles",
        [](Fixture& f) { rangeAngles(f.result.merged_m, f.directions, f.result.range_angle_rad); });
    add("7 singular spectrum analysis", [](Fixture& f) {
        smoothColumns(f.result.range_angle_rad, f.options.window_size,
                      f.options.principal_components, f.result.smoothed_rad);
    });
    add("8 labelling", [](Fixture& f) {
        labelRegions(f.result.repaired_m, f.result.pixel_angle_rad,
                     static_cast<float>(radians(f.options.beta_deg)), f.options.seeds,
                     static_cast<float>(radians(f.options.seed_gate_deg)), f.result.labels);
    });
    add("obstacles numbered", [](Fixture& f) {
        numberRoiComponents(f.result.repaired_m, f.result.labels, f.options.component_gap_m,
                            f.result.components);
    });
    add("9 extraction", [](Fixture& f) {
        extractReturns(f.scan, f.sensor, f.result.range_image, f.result.labels, f.result.components,
                       f.result.own_label, f.options.zone_m, f.options.component_gap_m,
                       f.result.returns);
    });
    add("paper pipeline", [](Fixture& f) {
        decodePackets(*f.observation, f.scan);
        f.filter.segment(f.scan);
    });
}

}  // namespace

int main(int argc, char** argv) {
    benchmark::Initialize(&argc, argv);
    if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
    try {
        papers();
    } catch (const std::exception& e) {
        std::cerr << "stage-benchmarks: " << e.what() << " (install mrpt-common)\n";
        return 1;
    }
    addAll();
    addOurs();
    benchmark::RunSpecifiedBenchmarks();
    return 0;
}
