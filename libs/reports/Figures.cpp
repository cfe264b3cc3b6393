#include <hagen/reports/Figures.h>

namespace hagen::reports {

std::string intervalText(const trials::Bounds& bounds, int decimals) {
    return pages::figure(bounds.low, decimals) + " to " + pages::figure(bounds.high, decimals);
}

std::string percent(double share) { return pages::figure(100 * share, 1); }

std::string percentOf(int successes, int trials) {
    if (trials == 0) return "-";
    const trials::Bounds bounds = trials::wilsonInterval(successes, trials);
    return percent(static_cast<double>(successes) / trials) + " (" + percent(bounds.low) + " to " +
           percent(bounds.high) + ")";
}

std::string percentOfRuns(int successes, int runs) {
    if (runs == 0) return "-";
    std::string text = percentOf(successes, runs);
    text.insert(text.size() - 1, "; " + std::to_string(runs));
    return text;
}

std::string pText(double p) { return p < 0.001 ? "<0.001" : pages::figure(p, 3); }

}  // namespace hagen::reports
