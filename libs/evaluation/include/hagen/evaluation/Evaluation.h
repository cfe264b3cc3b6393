#pragma once
#include <hagen/evaluation/Camera.h>
#include <hagen/evaluation/ScanScores.h>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace hagen::evaluation {

/// Labelled scans of one sensor, wherever they come from.
struct ScanSource {
    std::string name;  ///< in tables
    std::size_t scans = 0;
    std::function<TrueScan(std::size_t scan)> read;
    std::function<std::string(std::size_t scan)> scanName;  ///< for messages
    LabelMap kinds;                                         ///< what the kinds of its scans are
    /// Makes the methods for its sensor: of the same names, in the same order, for each source.
    std::function<std::vector<Method>()> makeMethods;
};

struct EvaluationOptions {
    RangeBands range;
    std::optional<PinholeCamera> camera;  ///< scores over its pixels too
};

/// What one method reached, scan by scan.
struct MethodScores {
    std::string name;
    std::vector<ScanScores> returns;  ///< over returns
    std::vector<ScanScores> pixels;  ///< over the camera's pixels, a return each; without one empty
    std::vector<double> latency_ms;  ///< of each call of Method::segment
};

/// A scan as one method labelled it, for those who want to look.
struct LabelledView {
    std::size_t source, scan;
    std::size_t method, methods;  ///< which, of how many
    const std::string& method_name;
    const TrueScan& truth;
    const std::vector<Label>& found;
    const std::vector<CameraPixel>& pixels;  ///< empty without a camera
};
using EvaluationListener = std::function<void(const LabelledView&)>;

/// Segments every scan with every method, and scores the labels. One scan is in memory at a time.
/// A method sees the first scan of each source twice, the first time to warm up, unscored and
/// untimed. Throws std::runtime_error, naming the scan, where labels do not fit it, and
/// std::invalid_argument where there is no source, or sources have different methods.
std::vector<MethodScores> evaluate(const std::vector<ScanSource>& sources,
                                   const EvaluationOptions& options = {},
                                   const EvaluationListener& listener = {});

}  // namespace hagen::evaluation
