#include <hagen/trials/LatencyProfile.h>
#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace hagen {

double LatencyProfile::draw_ms(const std::string& stage, Random& random) const {
    const auto found = quantiles_ms.find(stage);
    if (found == quantiles_ms.end() || found->second.empty()) {
        throw std::runtime_error("the latency profile has no stage \"" + stage + "\"");
    }
    const std::vector<double>& q = found->second;
    const double at = random.uniform() * static_cast<double>(q.size() - 1);
    const auto before = static_cast<std::size_t>(at);
    const double share = at - static_cast<double>(before);
    return before + 1 < q.size() ? q[before] + share * (q[before + 1] - q[before]) : q.back();
}

}  // namespace hagen
