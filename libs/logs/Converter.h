#pragma once
#include <hagen/logs/Conversion.h>
#include <hagen/logs/LogPoses.h>
#include <hagen/observations/ObservationSegmenter.h>
#include <mrpt/obs/CObservation.h>
#include <mrpt/serialization/CSerializable.h>

#include <exception>
#include <functional>
#include <memory>
#include <mutex>
#include <set>
#include <string>
#include <vector>

#include "ConversionOutputs.h"

namespace hagen::logs {

/// Segmenters with the same settings, lent out and used again. What one of them says of a scan is
/// valid while it is lent out.
class SegmenterPool {
 public:
    explicit SegmenterPool(
        std::function<std::unique_ptr<observations::ObservationSegmenter>()> make)
        : make_(std::move(make)) {}

    using Lease = std::unique_ptr<observations::ObservationSegmenter,
                                  std::function<void(observations::ObservationSegmenter*)>>;
    Lease lease();  ///< on any thread

 private:
    std::function<std::unique_ptr<observations::ObservationSegmenter>()> make_;
    std::mutex is_used_;
    std::vector<std::unique_ptr<observations::ObservationSegmenter>> idle_;
};

/// A LiDAR scan on its way through a conversion.
struct ScanOnItsWay {
    mrpt::obs::CObservation::ConstPtr observation;
    std::string name;  ///< in its scan folder, if it is from one
    observations::ObservationSegmenter::Whereabouts whereabouts;

    SegmenterPool::Lease segmenter;  ///< holds what `segmented` points to
    bool is_segmented = false;       ///< `segmented` is about it
    std::string why_not;             ///< it could not be read
    observations::ObservationSegmenter::Output segmented;
    mrpt::obs::CObservation::Ptr preview;
};

/// An entry of a log on its way through a conversion, with the scans in it that are segmented.
struct EntryOnItsWay {
    std::size_t number = 0;
    double fraction = 0;                             ///< of the input that is read with it
    mrpt::serialization::CSerializable::Ptr object;  ///< none: scans alone go into the output
    std::vector<ScanOnItsWay> scans;
    std::exception_ptr failure;   ///< that ends the conversion once the entries before it are done
    Bytes bytes, member, packed;  ///< of the output
};

/// One conversion on its way: segments observations, and counts. Entries are segmented on several
/// threads, and all that a user sees of it is in the log's order.
class Converter {
 public:
    Converter(const Conversion& conversion, const observations::Settings& settings,
              const ConversionListener& listener);

    /// Throws std::runtime_error where an output needs poses, and none are known.
    void setPoses(const LogPoses& poses);

    /// Reads entries until read() says that there are no more. An entry that breaks off, or a
    /// listener that ends it, leaves what was done before, which is told as so many `what`.
    void run(const std::function<bool(EntryOnItsWay&)>& read, const std::string& what);
    /// Ends it well. `entries` of the input were seen.
    ConversionReport finish(std::size_t entries);

    // For run()'s read().
    /// Whether the entry is one to convert; counts those that are not. Throws Interrupted.
    bool takes(std::size_t entry);
    bool isBeyond(std::size_t entry) const { return entry > conversion_.to; }
    bool wantsRawlog() const { return outputs_.wantsRawlog(); }
    /// Notes what an observation tells of the vehicle.
    void see(const mrpt::obs::CObservation& observation);
    /// Adds an observation to the scans of its entry, where it is one to segment.
    void add(const mrpt::obs::CObservation::ConstPtr& observation, EntryOnItsWay& entry,
             const std::string& name = "");

 private:
    bool isWanted(const mrpt::obs::CObservation& observation);
    void segment(ScanOnItsWay& scan);
    void serialiseAll(EntryOnItsWay& entry) const;
    void work(EntryOnItsWay& entry);
    void insertIntoMap(const ScanOnItsWay& scan, const std::string& entry);
    void account(ScanOnItsWay& scan, const EntryOnItsWay& entry);
    void account(EntryOnItsWay& entry);
    void count(const observations::ObservationSegmenter::Output& out, const ScanReport& scan);
    void tellRemarks(const ScanOnItsWay& scan, const std::string& entry);
    void checkLabels() const;
    template <class Error>
    [[noreturn]] void endEarly(const Error& why, const std::string& what);

    const Conversion& conversion_;
    const ConversionListener& listener_;
    std::mutex listens_;           ///< reading asks the listener while it is told of other entries
    bool levels_by_file_ = false;  ///< poses that the user gave win over what the log tells
    bool has_window_;              ///< a scan is segmented after those before it
    observations::Trajectory vehicle_;
    ConversionOutputs outputs_;
    observations::ObservationSegmenter
        horizon_;  ///< sees the log in its order, and segments nothing
    SegmenterPool segmenters_;
    ConversionReport report_;
    std::set<std::string> other_labels_;  ///< of LiDAR scans that were not wanted
};

}  // namespace hagen::logs
