#pragma once
#include <embree3/rtcore.h>
#include <memory>
#include <type_traits>

namespace hagen::simulation {

struct ReleaseScene {
    void operator()(RTCScene scene) const { rtcReleaseScene(scene); }
};
using ScenePtr = std::unique_ptr<std::remove_pointer_t<RTCScene>, ReleaseScene>;

/// Returns the device of this process: one thread and one instruction set, so that results for a
/// seed are identical on all machines. Errors throw std::runtime_error. Never released, because
/// oneTBB would start threads, and terminate the process on failure.
RTCDevice embreeDevice();

/// Attaches a geometry and transfers its ownership to the scene.
void attach(RTCScene scene, RTCGeometry geometry);

}  // namespace hagen::simulation
