#include <hagen/reports/Answer.h>
#include <hagen/reports/Saturation.h>

#include <algorithm>

namespace hagen::reports {
namespace {

bool isOf(const Saturation& saturation, const Pairing& pairing) {
    return saturation.scenario == pairing.scenario && saturation.condition == pairing.condition &&
           saturation.first == pairing.first;
}

}  // namespace

std::vector<Saturation> saturationsOf(const Summary& summary) {
    std::vector<Saturation> all;
    for (const Pairing& pairing : summary.pairings) {
        if (pairing.second.model == pairing.first.model) continue;
        auto found = std::find_if(all.begin(), all.end(),
                                  [&](const Saturation& one) { return isOf(one, pairing); });
        if (found == all.end()) {
            found = all.insert(all.end(),
                               {pairing.scenario, pairing.condition, pairing.first, 0, 0, true});
        }
        ++found->comparisons;
        found->alike += pairing.alike_scenarios;
        found->is_saturated = found->is_saturated && answerOf(pairing) == Answer::Saturated;
    }
    const auto rank = [&](const Saturation& one) {
        const auto condition =
            std::find(summary.conditions.begin(), summary.conditions.end(), one.condition);
        return std::make_tuple(condition, one.first, one.scenario);
    };
    std::sort(all.begin(), all.end(),
              [&](const Saturation& a, const Saturation& b) { return rank(a) < rank(b); });
    return all;
}

std::optional<Saturation> unsaturated(const std::vector<Saturation>& saturations,
                                      const Saturation& one) {
    std::optional<Saturation> lowest;
    for (const Saturation& other : saturations) {
        trials::Condition condition = other.condition;
        condition.speed_m_s = one.condition.speed_m_s;
        const bool is_of_series = other.scenario == one.scenario && other.first == one.first &&
                                  condition == one.condition;
        if (!is_of_series || other.is_saturated) continue;
        if (!lowest || other.condition.speed_m_s < lowest->condition.speed_m_s) lowest = other;
    }
    return lowest;
}

}  // namespace hagen::reports
