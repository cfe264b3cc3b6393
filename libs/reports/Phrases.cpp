#include "Phrases.h"
#include <hagen/avoidance/WorldModel.h>
#include <hagen/reports/Figures.h>

namespace hagen::reports {

std::string points(double share) {
    const std::string text = pages::figure(100 * share, 1);
    return share > 0 && text != "0.0" ? "+" + text : text;
}

std::string pointsOf(const trials::Bounds& bounds) {
    return points(bounds.low) + " to " + points(bounds.high);
}

std::string join(const std::vector<std::string>& words, const std::string& between) {
    std::string text;
    for (const std::string& word : words) text += (text.empty() ? "" : between) + word;
    return text;
}

std::string listed(const std::vector<std::string>& words) {
    if (words.size() < 2) return join(words, "");
    return join({words.begin(), words.end() - 1}, ", ") + " and " + words.back();
}

std::string counted(int count, const std::string& what) {
    return std::to_string(count) + " " + what + (count == 1 ? "" : "s");
}

std::string capital(std::string text) {
    if (!text.empty() && text[0] >= 'a' && text[0] <= 'z') {
        text[0] = static_cast<char>(text[0] - 'a' + 'A');
    }
    return text;
}

std::string withGuidance(const trials::Contender& contender) {
    return avoidance::displayName(contender.model) +
           (contender.guidance == "astar" ? " with A*" : " with straight guidance");
}

}  // namespace hagen::reports
