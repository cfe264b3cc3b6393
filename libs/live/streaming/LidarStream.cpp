#include <hagen/live/LidarStream.h>
#include <hagen/scan/Airframe.h>

#include <utility>

#include "live/streaming/CheckTime.h"

namespace hagen::live {
namespace {

// Context of sensors without a rotating head. A 20 ms frame is as old as its last packet.
constexpr double kFrameContext_s = 0.1 - 0.02 / 2;

}  // namespace

LidarStream::LidarStream(std::unique_ptr<sensors::LidarDriver> driver, const Settings& settings,
                         StreamingSegmenter::Take take, const StreamingOptions& streaming)
    : driver_(std::move(driver)), settings_(settings) {
    SensorModel sensor = driver_->sensor();
    sensor.min_range_m = settings.sensor.min_range_m.value_or(sensor.min_range_m);
    sensor.max_range_m = settings.sensor.max_range_m.value_or(sensor.max_range_m);
    filterFor(sensor, settings.options);  // throws SettingsError
    StreamingOptions options = streaming;
    if (!driver_->turns()) {
        options = {};
        options.context_s = kFrameContext_s;
    }
    const BeamOffsets offsets = driver_->beamOffsets(static_cast<double>(sensor.min_range_m));
    segmenter_ = std::make_unique<StreamingSegmenter>(std::move(sensor), settings.options,
                                                      std::move(take), options);
    segmenter_->setBeamOffsets(offsets);
    segmenter_->setMount(settings_.tiltOnLevelVehicle());
}

sensors::Taken LidarStream::add(const sensors::Datagram& datagram, double arrival_s) {
    checkTime(arrival_s);
    return driver_->add(datagram, arrival_s, *this);
}

void LidarStream::move(const SensorMotion& motion) {
    segmenter_->setAttitude(motion.attitude);
    segmenter_->setPose(motion.map_from_sensor);
}

void LidarStream::add(Scan& returns, const sensors::Sweep& sweep, double arrival_s) {
    returns_masked_ += maskAirframe(settings_.airframe.parts, returns);
    segmenter_->setView(driver_->view_rad());
    segmenter_->add(returns, sweep, arrival_s);
}

void LidarStream::addFrame(Scan& returns, const Frame& frame) {
    returns_masked_ += maskAirframe(settings_.airframe.parts, returns);
    segmenter_->addFrame(returns, frame.last_arrival_s, frame.measured_s, frame.first_arrival_s,
                         frame.sensor_time_s);
}

void LidarStream::flush() {
    driver_->flush(*this);
    if (driver_->turns()) segmenter_->flush();
}

}  // namespace hagen::live
