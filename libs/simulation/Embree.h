#pragma once
// Embree 3 and 4.
#if __has_include(<embree4/rtcore.h>)
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif
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

/// Casts the rays whose valid_lanes entry is -1. Both arguments have the alignment of AVX.
inline void castIncoherent(RTCScene scene, const int* valid_lanes, RTCRayHit8* rays) {
#if RTC_VERSION_MAJOR >= 4
    rtcIntersect8(valid_lanes, scene, rays);
#else
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    context.flags = RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT;
    rtcIntersect8(valid_lanes, scene, &context, rays);
#endif
}

/// Attaches a geometry and transfers its ownership to the scene.
void attach(RTCScene scene, RTCGeometry geometry);

}  // namespace hagen::simulation
