#include "CloudTimes.h"

#include <hagen/base/NumberText.h>

#include <algorithm>
#include <optional>
#include <string_view>

namespace hagen::logs {
namespace {

constexpr double kPeriod_s = 0.1;

std::size_t digitsAtEnd(std::string_view text) {
    std::size_t digits = 0;
    while (digits < text.size() && text[text.size() - 1 - digits] >= '0' &&
           text[text.size() - 1 - digits] <= '9') {
        ++digits;
    }
    return digits;
}

/// A name's number: two groups of digits with a mark between them, or one.
struct NameNumber {
    std::string_view whole, part;
    char mark = '\0';
};

NameNumber numberIn(std::string_view name) {
    NameNumber number;
    number.whole = name.substr(name.size() - digitsAtEnd(name));
    name.remove_suffix(number.whole.size());
    if (number.whole.empty() || name.empty() || (name.back() != '.' && name.back() != '_')) {
        return number;
    }
    const char mark = name.back();
    name.remove_suffix(1);
    const std::size_t digits = digitsAtEnd(name);
    const bool are_nanoseconds = number.whole.size() == 9 && digits >= 9;
    if (digits == 0 || (mark == '_' && !are_nanoseconds)) return number;
    return {name.substr(name.size() - digits), number.whole, mark};
}

/// The time that a number is; none if it is a mere number.
std::optional<double> timeOf(const NameNumber& number) {
    const auto whole = base::numberFrom<double>(number.whole);
    if (!whole) return std::nullopt;
    if (number.mark != '\0') {
        const auto part = base::numberFrom<double>("0." + std::string(number.part));
        return *whole + part.value_or(0.0);
    }
    switch (number.whole.size()) {
        case 10:
            return *whole;
        case 13:
            return 1e-3 * *whole;
        case 16:
            return 1e-6 * *whole;
        case 19:
            return 1e-9 * *whole;
        default:
            return std::nullopt;
    }
}

bool ascend(const std::vector<double>& numbers) {
    return std::adjacent_find(numbers.begin(), numbers.end(),
                              [](double a, double b) { return !(a < b); }) == numbers.end();
}

}  // namespace

double numberOfName(const std::string& name) {
    const NameNumber number = numberIn(name);
    if (const auto time_s = timeOf(number)) return *time_s;
    return base::numberFrom<double>(number.whole).value_or(-1.0);
}

CloudTimes timesOfNames(const std::vector<std::string>& names) {
    CloudTimes times;
    for (const std::string& name : names) {
        if (const auto time_s = timeOf(numberIn(name))) times.times_s.push_back(*time_s);
    }
    if (times.times_s.size() == names.size() && ascend(times.times_s)) {
        times.how = "the times of its clouds are those in the names of the files";
        return times;
    }
    constexpr double kMostNumber = 1e9;
    times.times_s.clear();
    bool are_numbers = true;
    for (const std::string& name : names) {
        const NameNumber number = numberIn(name);
        const double value = base::numberFrom<double>(number.whole).value_or(-1.0);
        are_numbers = are_numbers && number.mark == '\0' && value >= 0 && value < kMostNumber;
        times.times_s.push_back(kPeriod_s * value);
    }
    if (are_numbers && ascend(times.times_s)) {
        times.how =
            "its clouds have no times: they are taken to be 0.1 s apart, by the numbers in their "
            "names";
        return times;
    }
    for (std::size_t i = 0; i < names.size(); ++i) {
        times.times_s[i] = kPeriod_s * static_cast<double>(i);
    }
    times.how = "its clouds have no times: they are taken to be 0.1 s apart";
    return times;
}

}  // namespace hagen::logs
