#include "Phrases.h"

#include <hagen/avoidance/WorldModel.h>
#include <hagen/reports/Answer.h>
#include <hagen/reports/Figures.h>
#include <cmath>

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

std::string rivalOf(const Pairing& pairing) {
    return pairing.second.guidance == pairing.first.guidance
               ? avoidance::displayName(pairing.second.model)
               : withGuidance(pairing.second);
}

std::string placeOf(const std::string& scenario) {
    if (scenario == kAllButWires) return "without wires";
    if (scenario == kThinWires) return "on thin wires";
    return scenario == kWires ? "on wires" : scenario.empty() ? "" : "in " + scenario;
}

std::string marginText() { return pages::figure(100 * kMargin, 0) + " points"; }

std::string testText(const Pairing& pairing) {
    if (!std::isnan(pairing.p_holm)) return "p " + pText(pairing.p_holm);
    return counted(pairing.discordant(), "course") +
           (pairing.discordant() == 1 ? " differs" : " differ") + ", too few for a test";
}

std::string disagreementText(const Pairing& pairing) {
    if (excludesZero(pairing) == isSignificant(pairing)) return "";
    return excludesZero(pairing)
               ? "the interval excludes a difference of zero, the corrected test does not"
               : "the corrected test excludes a difference of zero, the interval does not";
}

std::string figuresOf(const Pairing& pairing) {
    const double n = pairing.pairs();
    const std::string success = percent((pairing.both + pairing.only_first) / n) + " % vs. " +
                                percent((pairing.both + pairing.only_second) / n) + " % of " +
                                counted(pairing.pairs(), "course");
    if (pairing.discordant() == 0) return success + ", none of which differs";
    const std::string disagreement = disagreementText(pairing);
    return success + "; " + points(pairing.difference) + " points, " + pointsOf(pairing.interval) +
           "; " + testText(pairing) + (disagreement.empty() ? "" : "; " + disagreement);
}

}  // namespace hagen::reports
