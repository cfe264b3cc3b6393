#pragma once
#include <hagen/convert/Conversion.h>
#include <hagen/mrpt/ObservationSegmenter.h>
#include <hagen/recordings/ScanSource.h>

#include <atomic>
#include <exception>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "convert/ConversionOutputs.h"
#include "convert/SegmenterPool.h"
#include "recordings/SensorCheck.h"

namespace hagen::convert {

/// A scan during its conversion.
struct ScanInConversion {
    recordings::RecordedScan recorded;
    SegmenterPool::Lease segmenter;  ///< holds what `segmented` points to
    bool is_segmented = false;       ///< `segmented` is valid
    std::string unreadable_because;  ///< why the scan could not be read
    observations::ObservationSegmenter::Output segmented;
    mrpt::obs::CObservation::Ptr preview;
};

/// An entry during its conversion: read, segmented, accounted for, compressed and written.
struct EntryInConversion {
    double fraction_read = 0;
    mrpt::serialization::CSerializable::Ptr object;  ///< none: only scans are written
    std::vector<ScanInConversion> scans;
    std::size_t results_replaced = 0;  ///< of an earlier run, taken out of the object
    std::exception_ptr failure;        ///< ends the conversion once all entries before it are done
    Bytes bytes, member, packed;       ///< buffers of the output
};

/// A conversion in progress. Entries are segmented on several threads; all outputs and callbacks
/// follow the order of the recording.
class Converter {
 public:
    Converter(const Conversion& conversion, const ConversionListener& listener);
    ConversionReport run();

 private:
    // The steps of the pipeline (OrderedPipeline.h), and their parts.
    bool read(EntryInConversion& entry);
    void segment(EntryInConversion& entry);
    void account(EntryInConversion& entry);

    recordings::SourceOptions sourceOptions();
    void usePoses();
    void segment(ScanInConversion& scan);
    void serialiseAll(EntryInConversion& entry) const;
    void account(ScanInConversion& scan);
    void reportRemarks(const ScanInConversion& scan);
    void insertIntoMap(const ScanInConversion& scan);
    void count(const observations::ObservationSegmenter::Output& out, const ScanReport& scan,
               const std::string& title);
    ConversionReport finish();
    bool isReplaced(const EntryInConversion& entry) const;
    void checkSensor(const ScanInConversion& scan);
    void finishSensorCheck();
    void remarkOnPartialOutputs();
    void remarkOnNothingFound();
    void remarkOnRecording();
    void checkLabels() const;
    void accountInOrder(EntryInConversion& entry);
    [[noreturn]] void keepWhatThereIs();

    const Conversion& conversion_;
    const ConversionListener& listener_;
    std::mutex listener_mutex_;  ///< the listener is also called by reading, on another thread
    std::unique_ptr<recordings::ScanSource> source_;
    const Settings settings_;  ///< with those of the recording's own sensor
    ConversionOutputs outputs_;
    SegmenterPool segmenters_;
    /// Time of the last scan that was segmented, by sensor label.
    std::map<std::string, mrpt::Clock::time_point> last_segmented_;
    recordings::SensorCheck sensor_check_;
    ConversionReport report_;
    // Why the conversion ends early; each is written by one step only. After the entry that ended
    // accounting, nothing is in an output.
    std::exception_ptr reading_ended_, accounting_ended_, end_;
    std::atomic<bool> has_ended_{false};  ///< nothing needs to be read any more
};

}  // namespace hagen::convert
