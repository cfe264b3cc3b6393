#include "live/Priority.h"

#include <pthread.h>
#include <sched.h>

namespace hagen::live {

void lowerPriority() {
    int policy = SCHED_OTHER;
    sched_param priority{};
    if (pthread_getschedparam(pthread_self(), &policy, &priority) != 0) return;
    const bool is_real_time = policy == SCHED_FIFO || policy == SCHED_RR;
    if (!is_real_time || priority.sched_priority <= sched_get_priority_min(policy)) return;
    --priority.sched_priority;
    pthread_setschedparam(pthread_self(), policy, &priority);  // lowering needs no privilege
}

void leaveRealTime() {
    const sched_param none{};
    pthread_setschedparam(pthread_self(), SCHED_OTHER, &none);  // lowering needs no privilege
}

}  // namespace hagen::live
