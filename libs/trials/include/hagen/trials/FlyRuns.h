#pragma once
#include <hagen/trials/LatencyProfile.h>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace hagen::trials {

/// Flies the runs with these keys (see keyOf) one after the other, and appends each to a journal
/// once it is finished. Consecutive runs of one course make it once. Stops early, even in mid
/// flight, when `keep_going` returns false; the unfinished run leaves no trace.
/// Throws std::runtime_error for an invalid key or a journal that cannot be written,
/// std::invalid_argument for unknown names.
void flyRuns(const std::vector<std::string>& keys, const LatencyProfile& profile,
             const std::filesystem::path& journal, const std::function<bool()>& keep_going);

/// Has this process killed when the thread that started it ends, and at once if its parent is not
/// this process any more: nothing is flown for a campaign that was killed.
void endWithParent(int parent_pid);

}  // namespace hagen::trials
