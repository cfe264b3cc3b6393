#pragma once
#include <string>
#include <vector>

namespace hagen::test {

/// Numbers as in memory, i.e. little-endian.
template <class Number>
std::string raw(Number number) {
    return {reinterpret_cast<const char*>(&number), sizeof number};
}
template <class Number>
std::string raw(const std::vector<Number>& numbers) {
    return {reinterpret_cast<const char*>(numbers.data()), numbers.size() * sizeof(Number)};
}

}  // namespace hagen::test
