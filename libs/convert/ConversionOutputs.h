#pragma once
#include <hagen/convert/Conversion.h>
#include <hagen/mrpt/ObservationSegmenter.h>
#include <hagen/mrpt/ScanMap.h>
#include <array>
#include <atomic>
#include <deque>
#include <map>
#include <mutex>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>
#include "base/OutputSet.h"
#include "convert/RawlogWriter.h"
#include "convert/ScanFolderWriter.h"
#include "convert/SensorFolders.h"

#include "convert/CloudOutput.h"
#include "convert/McapOutput.h"
#include "convert/ViewOutput.h"

namespace hagen::convert {

/// The paths of the requested outputs.
std::vector<std::filesystem::path> outputsOf(const Conversion& conversion);

/// An OctoMap of the scans of a log, written to one or several files.
class MapOutput {
 public:
    /// Throws std::runtime_error naming a file that has an unknown map format or cannot be written,
    /// and std::invalid_argument if options are out of range.
    MapOutput(const std::vector<std::filesystem::path>& files,
              const observations::ScanMapOptions& options, bool overwrite);

    void insert(const observations::MappedScan& scan) { map_.insert(scan); }

    /// Writes the map under temporary names. A failed file does not affect the others.
    void write();
    /// Throws std::runtime_error naming the files that could not be written, after renaming the
    /// others into place.
    void commit();
    /// Keeps partial files; returns their names, separated by spaces. Throws like commit().
    std::string keepPartial();

 private:
    observations::ScanMap map_;
    std::deque<base::OutputPath> files_;
    base::OutputSet all_;
};

/// The requested outputs of a conversion. If an output fails (full disk, full map, missing
/// matplotlib), it is aborted and commit() reports it; the others are not affected.
class ConversionOutputs {
 public:
    /// Throws std::runtime_error naming an output that cannot be written.
    explicit ConversionOutputs(const Conversion& conversion);

    /// Adds an entry and its clouds to the rawlog; see RawlogWriter.
    void gather(Bytes& entries, Bytes& member) {
        if (rawlog_) rawlog_->gather(entries, member);
    }
    /// Compresses and writes a member. May be called on any thread.
    void pack(const Bytes& member, Bytes& packed);
    void writeMember(const Bytes& packed);

    /// Adds a segmented scan to the sensor's scan folder, clouds and pictures, and to the MCAP. An
    /// empty name is replaced by the next number. Returns the name used.
    std::string writeScan(const observations::ObservationSegmenter::Output& segmented,
                          const recordings::RecordedScan& recorded, const Settings& settings);

    /// Adds a written scan to the page.
    void show(const ScanReport& report,
              const observations::ObservationSegmenter::Output& segmented);

    /// The output of labelled clouds; null if not requested.
    const CloudOutput* clouds() const { return clouds_ ? &*clouds_ : nullptr; }
    const McapOutput* mcap() const { return mcap_ ? &*mcap_ : nullptr; }

    const ViewOutput* view() const { return view_ ? &*view_ : nullptr; }

    bool wantsMap() const { return map_.has_value(); }
    /// Throws std::runtime_error if the scan does not fit into the map.
    void insertIntoMap(const observations::MappedScan& scan);
    void giveUpMap(const std::string& why) { giveUp(kMap, std::runtime_error(why)); }

    /// Returns false once all requested outputs have failed. Thread-safe.
    bool hasAny() const;

    /// Renames the outputs into place. Then throws std::runtime_error naming each failed output,
    /// the reason, and its partial file.
    void commit(const ConversionReport& report);
    /// Keeps the incomplete outputs under partial names; returns these names and the failures.
    std::string keepPartial(const ConversionReport& report);

 private:
    enum Part { kRawlog, kFolders, kClouds, kMcap, kPictures, kView, kMap, kStats, kParts };
    /// Runs a step of an output; if it fails, marks the output as failed.
    template <class Step>
    void attempt(Part part, Step step);
    void giveUp(Part part, const std::exception& why);
    template <class Do>
    void forEach(Do act);

    void writeToFolder(const observations::ObservationSegmenter::Output& segmented,
                       const recordings::RecordedScan& recorded, const std::string& name,
                       const Settings& settings);
    void drawPictures(const observations::ObservationSegmenter::Output& segmented,
                      const recordings::RecordedScan& recorded);
    void finishFolders();
    void finish(const ConversionReport& report);
    bool hasWholeParts(Part part) const;
    std::string whatFailed();

    const Conversion& conversion_;
    const std::array<std::filesystem::path, kParts> paths_;  ///< empty if not requested
    std::optional<RawlogWriter> rawlog_;
    std::optional<SensorFolders> folders_, pictures_;
    std::optional<CloudOutput> clouds_;
    std::optional<McapOutput> mcap_;
    std::optional<ViewOutput> view_;
    std::optional<MapOutput> map_;
    std::optional<base::OutputPath> stats_;
    std::array<std::atomic<bool>, kParts> is_given_up_{};  ///< read on several threads
    std::mutex why_mutex_;
    std::array<std::string, kParts> why_;
    std::map<std::string, ScanFolderWriter> folder_writers_;  ///< by sensor label
    std::map<std::string, std::size_t> scans_;                ///< number of scans written so far
    bool are_folders_finished_ = false, is_mcap_finished_ = false;
};

}  // namespace hagen::convert
