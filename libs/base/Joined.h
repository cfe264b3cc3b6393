#pragma once
#include <string>

namespace hagen::base {

/// The texts of a container in its order, separated.
template <typename Texts>
std::string joined(const Texts& texts, const std::string& separator = ", ") {
    std::string all;
    for (const std::string& text : texts) all += (all.empty() ? "" : separator) + text;
    return all;
}

}  // namespace hagen::base
