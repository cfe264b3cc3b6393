#include "base/command_line/Stacks.h"

#include <pthread.h>
#include <sys/resource.h>

#include <cstddef>

namespace hagen::base {
namespace {

constexpr std::size_t kStackBytes = 8 << 20;

struct Call {
    const std::function<int()>& work;
    int result;
};

void* runCall(void* call) {
    Call& it = *static_cast<Call*>(call);
    it.result = it.work();
    return nullptr;
}

}  // namespace

int withRoomyStacks(const std::function<int()>& work) noexcept {
    rlimit limit{};
    const bool is_small = getrlimit(RLIMIT_STACK, &limit) == 0 && limit.rlim_cur < kStackBytes;
    pthread_attr_t attributes;
    if (!is_small || pthread_attr_init(&attributes) != 0) return work();
    Call call{work, 0};
    pthread_t thread;
    const bool is_started = pthread_attr_setstacksize(&attributes, kStackBytes) == 0 &&
                            pthread_setattr_default_np(&attributes) == 0 &&
                            pthread_create(&thread, &attributes, runCall, &call) == 0;
    pthread_attr_destroy(&attributes);
    if (!is_started) return work();
    pthread_join(thread, nullptr);
    return call.result;
}

}  // namespace hagen::base
