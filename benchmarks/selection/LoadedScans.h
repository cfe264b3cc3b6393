// Labelled scans in memory, for scoring many settings.
#pragma once
#include <hagen/evaluation/DroneScores.h>
#include <hagen/evaluation/Evaluation.h>
#include <hagen/settings/Settings.h>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "Descent.h"

namespace hagen::selection {

/// Scans to load: a folder and the sets of its scans.
struct ScanInputs {
    std::string folder;
    std::filesystem::path preset;  ///< settings of the sensor
    float zone_m = 20, max_range_m = 20;
    std::string degradation;  ///< see `--degrade`; empty for none
    /// A set and the label map of its ground truth; without a map, labels/ is used unchanged.
    struct Truth {
        ScanSet set;
        std::optional<evaluation::LabelMap> label_map;
    };
    std::vector<Truth> truths;  ///< ground truths of the same scans
};

class LoadedScans {
 public:
    /// Loads the scans of a folder. Throws like sourcesOf() and Degradation.
    void add(const ScanInputs& inputs);

    /// The unique sets of all inputs so far (by vote and drive).
    const std::vector<ScanSet>& sets() const { return sets_; }
    std::size_t scans() const { return scans_.size(); }

    /// Labels all scans with these settings, in several threads, and returns the counts of each
    /// set. Throws SettingsError if the settings do not fit a sensor.
    std::vector<Counts> measure(const std::vector<Setting>& settings, const Choice& choice) const;

 private:
    /// The settings for one kind of scan; scans with equal settings share filters.
    struct Kind {
        std::filesystem::path preset, sensor_file;
        std::string sensor;  ///< content of `sensor_file`
        float zone_m;
        bool is_upside_down;
    };
    struct Truth {
        std::size_t set;
        float max_range_m;
        evaluation::GroundTruthScan scan;
        std::unique_ptr<evaluation::DroneTruth> drone;  ///< refers to `scan`
    };
    struct LoadedScan {
        std::size_t kind;
        std::vector<std::unique_ptr<Truth>> truths;  ///< ground truths of the same returns
    };

    std::size_t kindOf(const ScanInputs& inputs, bool is_upside_down);
    std::size_t setOf(const ScanSet& set);
    static evaluation::Method methodFor(const Kind& kind, const std::vector<Setting>& settings,
                                        const Choice& choice);

    std::vector<ScanSet> sets_;
    std::vector<Kind> kinds_;
    std::vector<LoadedScan> scans_;
};

}  // namespace hagen::selection
