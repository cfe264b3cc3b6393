#pragma once
#include <hagen/live/Recording.h>
#include <hagen/logs/RawlogWriter.h>
#include <hagen/observations/ObservationSegmenter.h>
#include <mrpt/obs/CObservation.h>

#include <condition_variable>
#include <cstddef>
#include <deque>
#include <filesystem>
#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

namespace hagen::recording {

/// Writes the turns of a sensor as rawlog-segment does: each with its RoI and its ROU as whole
/// scans have them. A thread of its own labels, compresses and writes.
///
/// A file gets its name when it is complete. Until then, it has a temporary name beside it, and is
/// a readable rawlog up to the last turns at any time: each gzip member is written whole.
class TurnRecorder {
 public:
    struct Options {
        std::filesystem::path file;
        bool overwrite = false;
        /// A file ends with the turn that makes it this long; names are then NAME.0001.rawlog and
        /// so on. 0: one file. Without `overwrite`, there must be no file of such a name.
        std::size_t rotate_bytes = 0;
        /// What no recording may replace: inputs, and other outputs.
        std::vector<std::filesystem::path> others;
        /// Waits for the disk; false: turns that come too fast are left out.
        bool waits = false;
    };

    /// Throws std::runtime_error naming the file if it cannot be written; see OutputPath.
    TurnRecorder(Options options, const Settings& settings);
    /// Completes the file, unless finish() was called.
    ~TurnRecorder();
    TurnRecorder(const TurnRecorder&) = delete;
    TurnRecorder& operator=(const TurnRecorder&) = delete;

    void add(const mrpt::obs::CObservation::Ptr& turn);
    /// Why recording ended early, naming the file; empty: it goes on.
    std::string failure() const;
    /// Completes the file. Where a turn could not be written, `failure` names the file and what is
    /// left of it.
    live::Recorded finish();

 private:
    std::filesystem::path nextName();
    std::optional<std::size_t> numberOf(const std::filesystem::path& file) const;
    bool isNumbered(const std::filesystem::path& file) const;
    std::map<std::size_t, std::filesystem::path> numbered() const;
    void checkNumbers() const;
    void openNext();
    void work();
    void write(const mrpt::obs::CObservation::Ptr& turn);
    void endFile();
    void fail(const char* why) noexcept;

    const Options options_;
    observations::ObservationSegmenter segmenter_;
    observations::ObservationSegmenter::Output output_;
    std::optional<logs::RawlogWriter> writer_;
    std::filesystem::path writing_;  ///< its name
    std::size_t written_bytes_ = 0, number_ = 0;
    bool has_turns_ = false;    ///< of this file
    std::size_t gathered_ = 0;  ///< turns of the member that is not written yet
    bool is_in_hand_ = false;   ///< a turn that is not gathered yet
    logs::Bytes entries_, member_, packed_;
    live::Recorded recorded_;

    mutable std::mutex mutex_;
    std::condition_variable changed_;
    std::deque<mrpt::obs::CObservation::Ptr> waiting_;
    std::size_t left_out_ = 0;
    bool is_at_end_ = false;
    std::string failure_;
    std::thread thread_;
};

}  // namespace hagen::recording
