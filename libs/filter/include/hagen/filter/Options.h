#pragma once
namespace hagen {

/// Interpretation of section III-E by the labelling; see Labelling.h.
enum class Seeds {
    Lowest,         ///< the lowest pixel of a column is ground; its region is ROU
    TopAndNearest,  ///< the paper's literal text: the regions of top and nearest pixels are RoI
    Every           ///< every pixel is ROU; only the ground stages find RoI
};

/// All settings of the filter, named as in settings files. config/paper.yaml contains our
/// interpretation of the paper; the defaults differ.
struct Options {
    /// Radius of the avoidance zone; farther returns are ROU.
    float zone_m = 20.0f;
    /// Returns up to this range are projected, as context of the zone; at least zone_m.
    float context_m = 48.0f;
    /// Scans of the paper's sliding window (SlidingWindow.h); 1 segments each scan alone.
    int window_scans = 1;
    /// Older scans of the window only fill pixels that the newest scan leaves empty; if false, the
    /// closest return of all scans counts, as in the paper.
    bool window_fills_gaps = true;
    /// Label the returns of all scans of the window; if false, only of the newest.
    bool label_window = false;
    /// I_w, image columns per revolution; not more than the sensor's firings per revolution,
    /// because a column without returns separates its neighbours.
    int columns = 870;
    /// Fill one-pixel gaps of the depth image between vertical neighbours that differ by less than
    /// this; 0 for none.
    float repair_max_step_m = 1.0f;
    /// Fill the rows of dead beams (DeadBeams.h).
    bool bridge_dead_beams = true;
    /// Minimum persistence of a proximity maximum to be sharpened; 0 to sharpen every local
    /// maximum.
    float persistence_m = 0.5f;
    /// Standard deviations of the bilateral filter: spatial, in pixels, and of range, in metres.
    float sharpening_sigma_px = 1.2f;
    float sharpening_sigma_m = 1.3f;
    /// Add the weighted mean of its neighbours to a maximum; if false, its own value, as printed.
    bool sharpen_by_neighbours = true;
    /// Sharpen and merge proximity, which moves maxima nearer, or else depth, which moves them
    /// away.
    bool sharpen_proximity = true;
    /// A pixel gets the angle to the beam above or otherwise below; if false, vice versa.
    bool angle_to_beam_above = true;
    /// Angles to empty pixels are 0, so that columns have no gaps; if false, there is no angle.
    bool gaps_are_level = false;
    /// W, rows of the trajectory matrix of the singular spectrum analysis.
    int window_size = 8;
    /// PC, leading components kept; PC = W disables smoothing.
    int principal_components = 5;
    /// Skip stages 3 to 5 and 7: angles are those of the repaired depth image (faster).
    bool raw_angles = false;
    /// beta: neighbours whose range angles differ by less than this belong to one region.
    float beta_deg = 10.0f;
    /// The pixels that regions grow from.
    Seeds seeds = Seeds::Lowest;
    /// A seed is ground only if its angle is below this; 90 accepts all seeds.
    float seed_gate_deg = 30.0f;
    /// Measure angles relative to the horizon if the sensor's attitude is known.
    bool level_by_attitude = true;
    /// Relabel all pixels by their height above a surface fitted to the ROU.
    bool ground_surface = true;
    /// Near-surface pixels are ROU only where pixels on level steps indicate ground.
    bool ground_evidence = true;
    /// Maximum height of ground returns above that surface; see HeightTolerance.
    float ground_tolerance_m = 0.17f;
    float ground_tolerance_per_m = 0.005f;
    float ground_tolerance_beside_tall = 0.12f;
    /// Treat a low layer that covers most of the surroundings as crop canopy, not as an obstacle.
    bool canopy_layer = true;
    /// Extend obstacles down to their feet; remove isolated specks.
    bool grow_feet = true;
    bool remove_specks = true;
    /// Ground closer than this below the sensor is RoI; 0 for never.
    float ground_is_roi_below_m = 0.0f;
    /// Adjacent RoI pixels belong to one component if their depths differ by less than this.
    float component_gap_m = 1.0f;
    /// Number the obstacles: fill SegmentationResult::components and LabelledReturns::component.
    /// Set it in programs that use the numbers; it is not a key of settings files.
    bool number_obstacles = false;
};

/// Throws std::invalid_argument naming the setting if a setting is out of range (OptionKeys.h) or
/// if settings contradict each other or the sensor's number of beams (principal_components >
/// window_size, window_size >= beams).
void checkOptions(const Options& options, int beams);

}  // namespace hagen
