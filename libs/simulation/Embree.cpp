#include "Embree.h"

#include <stdexcept>
#include <string>

namespace hagen::simulation {
namespace {

void throwError(void*, RTCError, const char* message) {
    throw std::runtime_error(std::string("Embree: ") + message);
}

RTCDevice newDevice() {
    const RTCDevice device = rtcNewDevice("threads=1,isa=avx2");
    if (device == nullptr) throw std::runtime_error("Embree does not start");
    rtcSetDeviceErrorFunction(device, throwError, nullptr);
    return device;
}

}  // namespace

RTCDevice embreeDevice() {
    static const RTCDevice device = newDevice();
    return device;
}

void attach(RTCScene scene, RTCGeometry geometry) {
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(scene, geometry);
    rtcReleaseGeometry(geometry);
}

}  // namespace hagen::simulation
