#pragma once
#include <hagen/mrpt/ObservationSegmenter.h>

#include <functional>
#include <memory>
#include <mutex>
#include <vector>

namespace hagen::convert {

/// Segmenters with the same settings, lent to threads and reused.
class SegmenterPool {
 public:
    /// Throws SettingsError if settings and sensor are inconsistent.
    SegmenterPool(const Settings& settings, observations::CloudClass cloud_class);

    /// Returns the segmenter to the pool at its end, and with it the segmenter's output.
    using Lease = std::unique_ptr<observations::ObservationSegmenter,
                                  std::function<void(observations::ObservationSegmenter*)>>;
    Lease lease();  ///< on any thread

 private:
    const Settings settings_;
    const observations::CloudClass cloud_class_;
    std::mutex mutex_;
    std::vector<std::unique_ptr<observations::ObservationSegmenter>> idle_;
};

}  // namespace hagen::convert
