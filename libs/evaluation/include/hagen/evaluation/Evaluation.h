#pragma once
#include <hagen/evaluation/Camera.h>
#include <hagen/evaluation/DroneScores.h>
#include <hagen/evaluation/ScanScores.h>
#include <hagen/scan/SensorModel.h>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace hagen::evaluation {

/// Labelled scans of one sensor, read one by one.
class LabelledScanSource {
 public:
    virtual ~LabelledScanSource() = default;

    /// Reads the next scan; nullopt at the end.
    virtual std::optional<GroundTruthScan> next() = 0;

    virtual const std::string& name() const = 0;  ///< shown in tables
    virtual std::size_t size() const = 0;         ///< number of scans
    virtual const LabelMap& kinds() const = 0;    ///< object classes in the scans
    virtual SensorModel sensor() const = 0;       ///< sensor for which the scans are located
    /// Describes a recovered sensor; empty if the recording or the settings name the sensor.
    virtual std::string sensorText() const { return ""; }
    /// Unused parts of the source; complete after the last scan.
    virtual std::vector<std::string> remarks() const { return {}; }
    /// Creates the methods for the sensor. All sources must return the same names in this order.
    virtual std::vector<Method> makeMethods() const = 0;
};
using LabelledScanSources = std::vector<std::unique_ptr<LabelledScanSource>>;

struct EvaluationOptions {
    RangeBands range;
    std::optional<PinholeCamera> camera;  ///< if set, its pixels are scored, too
};

/// The results of one method, scan by scan.
struct MethodScores {
    std::string name;
    std::vector<ScanScores> returns;  ///< scores over returns
    std::vector<ScanScores> pixels;   ///< scores over camera pixels; empty without a camera
    std::vector<DroneScores> drone;
    std::vector<double> latency_ms;  ///< per call of Method::segment; empty if is_recorded
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

/// Segments every scan with every method and scores the labels. Reads all scans, so a source can be
/// evaluated only once. Every method first processes the first scan of each source as a warm-up,
/// which is neither scored nor timed. Throws std::runtime_error naming a scan with the wrong number
/// of labels, and std::invalid_argument if there are no sources or their methods differ.
std::vector<MethodScores> evaluate(const LabelledScanSources& sources,
                                   const EvaluationOptions& options = {},
                                   const EvaluationListener& listener = {});

}  // namespace hagen::evaluation
