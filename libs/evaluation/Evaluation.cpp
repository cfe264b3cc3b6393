#include <hagen/evaluation/Evaluation.h>
#include <chrono>
#include <stdexcept>

namespace hagen::evaluation {
namespace {

/// Runs a method, and records its run time unless its labels are precomputed.
std::vector<Label> timed(const Method& method, const ScanInput& input,
                         std::vector<double>& latency_ms) {
    if (method.is_recorded) return method.segment(input);
    using Clock = std::chrono::steady_clock;
    const auto before = Clock::now();
    std::vector<Label> found = method.segment(input);
    latency_ms.push_back(std::chrono::duration<double, std::milli>(Clock::now() - before).count());
    return found;
}

/// Adds the scan's name to errors about labels of the wrong size.
template <class Work>
auto forScan(const GroundTruthScan& scan, Work work) {
    try {
        return work();
    } catch (const std::invalid_argument& e) {
        throw std::runtime_error(scan.name + ": " + e.what());
    }
}

void checkMethods(const std::vector<Method>& methods, const std::string& source,
                  std::vector<MethodScores>& scores) {
    if (scores.empty()) {
        for (const Method& method : methods) scores.push_back({method.name, {}, {}, {}, {}});
    }
    bool are_same = methods.size() == scores.size();
    for (std::size_t m = 0; are_same && m < methods.size(); ++m) {
        are_same = methods[m].name == scores[m].name;
    }
    if (!are_same)
        throw std::invalid_argument(source +
                                    ": its methods differ from those of the previous source");
}

std::vector<std::size_t> returnsOf(const std::vector<CameraPixel>& pixels) {
    std::vector<std::size_t> indices;
    indices.reserve(pixels.size());
    for (const CameraPixel& pixel : pixels) indices.push_back(pixel.index);
    return indices;
}

}  // namespace

std::vector<MethodScores> evaluate(const LabelledScanSources& sources,
                                   const EvaluationOptions& options,
                                   const EvaluationListener& listener) {
    if (sources.empty()) throw std::invalid_argument("there are no scans to evaluate");
    std::vector<MethodScores> all;
    for (std::size_t s = 0; s < sources.size(); ++s) {
        LabelledScanSource& source = *sources[s];
        const std::vector<Method> methods = source.makeMethods();
        checkMethods(methods, source.name(), all);
        std::size_t i = 0;
        for (; auto pulled = source.next(); ++i) {
            const GroundTruthScan& scan = *pulled;
            std::vector<CameraPixel> pixels;
            if (options.camera) pixels = visibleReturns(*options.camera, scan.input.scan);
            const std::vector<std::size_t> seen = returnsOf(pixels);
            const DroneTruth drone = forScan(scan, [&] { return DroneTruth(scan, options.range); });
            for (std::size_t m = 0; m < methods.size(); ++m) {
                if (i == 0 && !methods[m].is_recorded) methods[m].segment(scan.input);
                const std::vector<Label> found = timed(methods[m], scan.input, all[m].latency_ms);
                const auto score = [&](const std::vector<std::size_t>* chosen,
                                       std::vector<ScanScores>& scores) {
                    scores.push_back(scoreScan(scan, found, source.kinds(), options.range, chosen));
                    scores.back().folder = s;
                };
                forScan(scan, [&] {
                    score(nullptr, all[m].returns);
                    if (options.camera) score(&seen, all[m].pixels);
                    all[m].drone.push_back(drone.score(found, source.kinds()));
                });
                if (listener)
                    listener({s, i, m, methods.size(), methods[m].name, scan, found, pixels});
            }
        }
        if (i < source.size()) {
            throw std::invalid_argument(source.name() + ": only " + std::to_string(i) + " of " +
                                        std::to_string(source.size()) +
                                        " scans left; a source can be evaluated only once");
        }
    }
    return all;
}

}  // namespace hagen::evaluation
