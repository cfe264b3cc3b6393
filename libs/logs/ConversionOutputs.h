#pragma once
#include <hagen/logs/Conversion.h>
#include <hagen/logs/MapOutput.h>
#include <hagen/logs/RawlogWriter.h>
#include <hagen/logs/ScanFolderWriter.h>
#include <hagen/logs/SensorFolders.h>
#include <hagen/observations/ObservationSegmenter.h>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "CloudOutput.h"
#include "McapOutput.h"

namespace hagen::logs {

/// The requested outputs of a conversion.
class ConversionOutputs {
 public:
    /// Throws std::runtime_error naming an output that cannot be written.
    explicit ConversionOutputs(const Conversion& conversion);

    bool wantsRawlog() const { return rawlog_.has_value(); }

    /// Adds an entry and its clouds to the rawlog; see RawlogWriter.
    void gather(Bytes& entries, Bytes& member) {
        if (rawlog_) rawlog_->gather(entries, member);
    }
    void writeMember(const Bytes& packed) { rawlog_->writeMember(packed); }

    /// Adds a segmented scan to the sensor's scan folder, clouds and pictures, and to the MCAP. An
    /// empty name stands for the next number. Returns the name used.
    std::string writeScan(const observations::ObservationSegmenter::Output& segmented,
                          const RecordedScan& recorded, const observations::Settings& settings);

    /// The labelled clouds written so far; null if there are none to write.
    const CloudOutput* clouds() const { return clouds_ ? &*clouds_ : nullptr; }

    /// The MCAP written so far; null if there is none to write.
    const McapOutput* mcap() const { return mcap_ ? &*mcap_ : nullptr; }

    /// Adds a scan to the map, if there is one.
    bool wantsMap() const { return map_.has_value(); }
    void insertIntoMap(const mapping::MappedScan& scan) { map_->insert(scan); }

    void commit(const ConversionReport& report);
    /// Keeps the incomplete outputs under partial names, and returns these names.
    std::string keepPartial(const ConversionReport& report);

 private:
    void drawPictures(const observations::ObservationSegmenter::Output& segmented,
                      const RecordedScan& recorded);
    void finish(const ConversionReport& report);

    const Conversion& conversion_;
    std::optional<RawlogWriter> rawlog_;
    std::optional<SensorFolders> folders_, pictures_;
    std::optional<CloudOutput> clouds_;
    std::optional<McapOutput> mcap_;
    std::optional<MapOutput> map_;
    std::optional<base::OutputPath> stats_;
    std::map<std::string, ScanFolderWriter> folder_writers_;  ///< by sensor label
    std::map<std::string, std::size_t> scans_;                ///< written so far
};

}  // namespace hagen::logs
