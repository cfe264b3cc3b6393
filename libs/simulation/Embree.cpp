#include "simulation/Embree.h"

#include <new>
#include <stdexcept>
#include <string>

namespace hagen::simulation {
namespace {

void throwError(void*, RTCError error, const char* message) {
    if (error == RTC_ERROR_OUT_OF_MEMORY) throw std::bad_alloc();
    throw std::runtime_error(std::string("Embree: ") + message);
}

RTCDevice newDevice() {
    const RTCDevice device = rtcNewDevice("threads=1,isa=avx2");
    if (device == nullptr) {
        const RTCError error = rtcGetDeviceError(nullptr);
        if (error == RTC_ERROR_OUT_OF_MEMORY) throw std::bad_alloc();
        throw std::runtime_error(error == RTC_ERROR_UNSUPPORTED_CPU
                                     ? "Embree requires a processor with AVX2"
                                     : "Embree failed to start: error " + std::to_string(error));
    }
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
