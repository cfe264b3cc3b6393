#include "recordings/FileListSource.h"

#include <hagen/recordings/BrokenRecording.h>

namespace hagen::recordings {

std::optional<RecordedEntry> FileListSource::nextEntry() {
    while (next_ < names_.size() && next_ <= options_.last_scan) {
        const std::size_t i = next_++;
        checkInterruption();
        if (skips(i)) continue;
        const Cloud cloud = read(i);
        RecordedEntry entry;
        entry.number = i;
        entry.fraction_read = static_cast<double>(i + 1) / static_cast<double>(names_.size());
        entry.object = take(cloud);
        addIfScan(cloud, names_[i], entry);
        return entry;
    }
    return endAfter(next_);
}

bool FileListSource::showClouds(CloudSensors& sensors) {
    if (next_shown_ >= names_.size()) return false;
    const std::size_t i = next_shown_++;
    try {
        observations::showCloud(*read(i), sensors);
    } catch (const BrokenRecording& e) {
        if (i >= options_.first_scan) brokeOffAhead(i, e.what());
    }
    return true;
}

std::map<std::string, std::vector<mrpt::Clock::time_point>> FileListSource::scanTimes() {
    std::vector<mrpt::Clock::time_point> times;
    for (std::size_t i = 0; i < names_.size(); ++i) times.push_back(timeOf(i));
    return {{label_, times}};
}

}  // namespace hagen::recordings
