#pragma once
#include <hagen/live/PacketQueue.h>
#include <mrpt/obs/CObservation.h>

#include <deque>
#include <filesystem>
#include <memory>
#include <string>

namespace hagen::recording {

/// Puts the data packets of a sensor of any maker together into turns; of one that does not turn,
/// into tenths of a second.
class SensorTurns {
 public:
    virtual ~SensorTurns() = default;

    /// Takes a data packet of the sensor; its arrival and addresses are not used.
    virtual void add(const live::Packet& packet) = 0;
    /// Completes the turn in progress.
    virtual void finish() = 0;

    /// The turns that are complete, oldest first. The caller takes them out.
    std::deque<mrpt::obs::CObservation::Ptr>& complete() { return complete_; }

 protected:
    std::deque<mrpt::obs::CObservation::Ptr> complete_;
};

/// A sensor as in live::LiveOptions: a model, or the metadata of an Ouster. Throws
/// std::runtime_error naming the file of metadata or calibration that cannot be used, and
/// std::invalid_argument for an unknown model.
std::unique_ptr<SensorTurns> makeSensorTurns(const std::string& model,
                                             const std::filesystem::path& sensor_json,
                                             const std::filesystem::path& calibration);

}  // namespace hagen::recording
