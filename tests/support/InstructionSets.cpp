#include "support/InstructionSets.h"

#include <hwy/highway.h>

#include <vector>

namespace hagen {
namespace {

void use(std::int64_t targets) {
    hwy::SetSupportedTargetsForTest(targets);
    hwy::GetChosenTarget().Update(hwy::SupportedTargets());
}

}  // namespace

void forEachInstructionSet(const std::function<void(const std::string& name)>& visit) {
    const std::vector<std::int64_t> best_first = hwy::SupportedAndGeneratedTargets();
    for (auto target = best_first.rbegin(); target != best_first.rend(); ++target) {
        use(*target);
        visit(hwy::TargetName(*target));
    }
    use(0);  // no restriction
}

}  // namespace hagen
