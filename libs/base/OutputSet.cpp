#include <hagen/base/OutputSet.h>
#include <exception>
#include <new>
#include <stdexcept>
#include <vector>

namespace hagen::base {

void OutputSet::write(const OutputPath& output, const std::function<void()>& step) {
    for (Member& member : members_) {
        if (member.path != output.path()) continue;
        return attempt(member, step, output.temporary().string());
    }
    throw std::logic_error(output.path().string() + ": is no output of this set");
}

void OutputSet::attempt(Member& member, const std::function<void()>& step,
                        const std::string& temporary) {
    if (member.is_given_up) return;
    std::string why;
    try {
        return step();
    } catch (const std::bad_alloc&) {
        why = "out of memory";
    } catch (const std::exception& e) {
        why = e.what();
    }
    member.is_given_up = true;
    const std::string name = member.path.string();
    for (std::size_t at = why.find(temporary); !temporary.empty() && at != std::string::npos;
         at = why.find(temporary, at + name.size())) {
        why.replace(at, temporary.size(), name);
    }
    if (why.find(name) == std::string::npos) why = name + ": " + why;
    failures_ += (failures_.empty() ? "" : "; ") + why;
}

void OutputSet::commit() {
    std::vector<std::filesystem::path> complete;
    for (const Member& member : members_) {
        if (!member.is_given_up) complete.push_back(member.path);
    }
    const RenamingNote note(complete);
    for (Member& member : members_) attempt(member, member.commit);
    if (!failures_.empty()) throw std::runtime_error(failures_);
}

}  // namespace hagen::base
