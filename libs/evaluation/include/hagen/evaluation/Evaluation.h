#pragma once
#include <hagen/evaluation/Camera.h>
#include <hagen/evaluation/ScanScores.h>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace hagen::evaluation {

/// Labelled scans of one sensor, from any source.
struct LabelledScanSource {
    std::string name;  ///< in tables
    std::size_t scans = 0;
    std::function<GroundTruthScan(std::size_t scan)> read;
    std::function<std::string(std::size_t scan)> scanName;  ///< for messages
    LabelMap kinds;                                         ///< the object classes of its scans
    /// Creates the methods for its sensor; every source must return the same names in the same
    /// order.
    std::function<std::vector<Method>()> makeMethods;
};

struct EvaluationOptions {
    RangeBands range;
    std::optional<PinholeCamera> camera;  ///< scores over its pixels too
};

/// The results of one method, scan by scan.
struct MethodScores {
    std::string name;
    std::vector<ScanScores> returns;  ///< over returns
    std::vector<ScanScores>
        pixels;  ///< over the camera's pixels, one return each; empty without a camera
    std::vector<double> latency_ms;  ///< of each call of Method::segment
};

/// A scan as labelled by one method, for visualisation.
struct MethodOutput {
    std::size_t source, scan;
    std::size_t method, methods;  ///< index of the method, and number of methods
    const std::string& method_name;
    const GroundTruthScan& truth;
    const std::vector<Label>& found;
    const std::vector<CameraPixel>& pixels;  ///< empty without a camera
};
using EvaluationListener = std::function<void(const MethodOutput&)>;

/// Segments every scan with every method and scores the labels. Only one scan is in memory at a
/// time. Every method processes the first scan of each source twice; the first time is a warm-up,
/// neither scored nor timed. Throws std::runtime_error if labels do not fit a scan (the message
/// names it), and std::invalid_argument if there is no source or the sources have different
/// methods.
std::vector<MethodScores> evaluate(const std::vector<LabelledScanSource>& sources,
                                   const EvaluationOptions& options = {},
                                   const EvaluationListener& listener = {});

}  // namespace hagen::evaluation
