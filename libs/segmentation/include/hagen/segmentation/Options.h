#pragma once
namespace hagen {

/// How the labelling interprets section III-E; see Labelling.h.
enum class Seeds {
    Lowest,        ///< the lowest pixel of a column is ground: what grows from it is ROU
    TopAndNearest  ///< the literal text: what grows from the top and the nearest pixel is RoI
};

/// All settings of the filter, named as in settings files. The defaults are ours; config/paper.yaml
/// has those of the paper.
struct Options {
    /// Radius of the avoidance zone: returns farther than this are ROU.
    float zone_m = 20.0f;
    /// Returns up to this range enter the image, as context of the zone; never less than zone_m.
    float context_m = 48.0f;
    /// I_w, the image's columns in a full turn; at most the sensor's firings per turn, because a
    /// column without returns separates its neighbours.
    int columns = 870;
    /// Fill one-pixel holes of the depth image between two vertical neighbours that differ by less;
    /// 0 repairs nothing.
    float repair_max_step_m = 1.0f;
    /// Least persistence of a maximum of proximity that is sharpened; 0 keeps every local maximum.
    float persistence_m = 0.5f;
    /// Standard deviations of the bilateral filter: spatial, in pixels, and of range, in metres.
    float sharpening_sigma_px = 1.2f;
    float sharpening_sigma_m = 1.3f;
    /// W, rows of the trajectory matrix of the singular spectrum analysis.
    int window_size = 8;
    /// PC, leading components kept; PC = W smooths nothing.
    int principal_components = 5;
    /// beta: neighbours whose range angles differ by less belong to one region.
    float beta_deg = 10.0f;
    /// The pixels that regions grow from.
    Seeds seeds = Seeds::Lowest;
    /// A seed is ground only if its angle is below this; 90 lets all pass.
    float seed_gate_deg = 30.0f;
    /// Whether angles are relative to the horizon where the sensor's attitude is known.
    bool level_by_attitude = true;
    /// Whether all pixels are labelled again, by their height above a surface fitted to the ROU.
    bool ground_surface = true;
    /// How high above that surface a return may be and still be ground; see HeightTolerance.
    float ground_tolerance_m = 0.17f;
    float ground_tolerance_per_m = 0.005f;
    float ground_tolerance_beside_tall = 0.12f;
    /// Whether a low layer that covers most of the surroundings is a crop's canopy, not an
    /// obstacle.
    bool canopy_layer = true;
    /// Whether obstacles are extended down to their feet, and lone specks removed.
    bool grow_feet = true;
    bool remove_specks = true;
    /// Ground less than this below the sensor is RoI; 0: never.
    float ground_is_roi_below_m = 0.0f;
    /// Adjacent RoI pixels belong to one component if their depths differ by less.
    float component_gap_m = 1.0f;
    /// K, consecutive scans that are segmented together; needs poses beyond 1.
    int window_scans = 1;
};

/// Throws std::invalid_argument, naming the setting, if one is out of its range (OptionKeys.h), or
/// if they contradict one another or the sensor's number of beams (principal_components >
/// window_size, window_size >= beams).
void checkOptions(const Options& options, int beams);

}  // namespace hagen
