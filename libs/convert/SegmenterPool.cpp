#include "convert/SegmenterPool.h"

#include <new>
#include <utility>

namespace hagen::convert {

using observations::ObservationSegmenter;

SegmenterPool::SegmenterPool(const Settings& settings, observations::CloudClass cloud_class)
    : settings_(settings), cloud_class_(cloud_class) {
    lease();  // reports inconsistent settings before anything is read
}

SegmenterPool::Lease SegmenterPool::lease() {
    const auto giveBack = [this](ObservationSegmenter* segmenter) {
        std::unique_ptr<ObservationSegmenter> owned(segmenter);
        const std::lock_guard lock(mutex_);
        try {
            idle_.push_back(std::move(owned));
        } catch (const std::bad_alloc&) {  // it is deleted; a deleter must not throw
        }
    };
    {
        const std::lock_guard lock(mutex_);
        if (!idle_.empty()) {
            Lease lease(idle_.back().release(), giveBack);
            idle_.pop_back();
            return lease;
        }
    }
    auto segmenter = std::make_unique<ObservationSegmenter>();
    segmenter->setMinLoggingLevel(mrpt::system::LVL_ERROR);  // remarks go to the listener
    segmenter->cloud_class = cloud_class_;
    segmenter->initialize(settings_);
    return Lease(segmenter.release(), giveBack);
}

}  // namespace hagen::convert
