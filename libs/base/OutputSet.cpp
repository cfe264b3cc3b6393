#include "base/OutputSet.h"
#include <algorithm>
#include <exception>
#include <new>
#include <stdexcept>
#include "base/MemoryLimit.h"

namespace hagen::base {

void OutputSet::write(const OutputPath& output, const std::function<void()>& step) {
    for (Member& member : members_) {
        if (member.path == output.path()) return attempt(member, step);
    }
    throw std::logic_error(output.path().string() + ": not an output of this set");
}

bool OutputSet::areAllGivenUp() const {
    return std::all_of(members_.begin(), members_.end(),
                       [](const Member& member) { return member.is_given_up; });
}

void OutputSet::attempt(Member& member, const std::function<void()>& step) {
    if (member.is_given_up) return;
    std::string why;
    try {
        return step();
    } catch (const std::bad_alloc&) {
        why = outOfMemory();
    } catch (const std::exception& e) {
        why = e.what();
    }
    member.is_given_up = true;
    const std::string name = member.path.string();
    why = withOutputNames(why);
    if (why.find(name) == std::string::npos) why = name + ": " + why;
    failures_ += (failures_.empty() ? "" : "; ") + why;
}

void OutputSet::commit() {
    for (Member& member : members_) attempt(member, member.commit);
    if (!failures_.empty()) throw std::runtime_error(failures_);
}

}  // namespace hagen::base
