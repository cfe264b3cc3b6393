#include "recordings/CloudTimes.h"

#include <hagen/mrpt/TimeStamp.h>
#include "base/NumberText.h"

#include <algorithm>
#include <numeric>
#include <regex>
#include <set>

namespace hagen::recordings {
namespace {

constexpr double kPeriod_s = 0.1;

/// The number in a name: one group of digits, or two groups separated by a '.' or '_'.
struct NameNumber {
    std::string_view whole, part;
    char mark = '\0';
    bool is_whole_name = false;
};

constexpr std::size_t kDigitsOfSeconds = 10, kDigitsOfNanoseconds = 9;

/// True for current Unix times: 10 digits without leading zeros, unlike padded frame numbers.
bool areUnixSeconds(std::string_view digits) {
    return digits.size() == kDigitsOfSeconds && digits[0] != '0';
}

NameNumber numberIn(const std::string& name) {
    static const std::regex kForm("([0-9]+)(?:([._])([0-9]+))?$");
    std::smatch match;
    if (!std::regex_search(name, match, kForm)) return {};
    const auto group = [&](int i) {
        return std::string_view(name).substr(static_cast<std::size_t>(match.position(i)),
                                             static_cast<std::size_t>(match.length(i)));
    };
    const bool is_whole_name = match.position() == 0;
    if (!match[2].matched) return {group(1), {}, '\0', is_whole_name};
    const std::size_t digits = group(3).size();
    const bool are_nanoseconds = digits == kDigitsOfNanoseconds
                                     ? group(1).size() >= kDigitsOfNanoseconds
                                     : digits < kDigitsOfNanoseconds && areUnixSeconds(group(1));
    const char mark = group(2)[0];
    if (mark == '_' && !are_nanoseconds) return {group(3), {}, '\0', false};
    return {group(1), group(3), mark, is_whole_name};
}

double valueOf(const NameNumber& number) {
    const double whole = base::numberFrom<double>(number.whole).value_or(-1.0);
    if (number.mark == '\0') return whole;
    if (number.mark == '_') {
        return whole + 1e-9 * base::numberFrom<double>(number.part).value_or(0.0);
    }
    return whole + base::numberFrom<double>("0." + std::string(number.part)).value_or(0.0);
}

/// The time that a number encodes; nullopt if it is not a time.
std::optional<double> timeIn(const NameNumber& number) {
    if (number.whole.empty()) return std::nullopt;
    const double value = valueOf(number);
    if (number.mark == '_') {
        // A padded second group with fewer than nine digits does not contain nanoseconds.
        const bool is_padded = number.part.size() > 1 && number.part[0] == '0';
        if (is_padded && number.part.size() < kDigitsOfNanoseconds) return std::nullopt;
        return value;
    }
    if (number.mark == '.') {
        // For example, "vlp16.000001" is the first cloud of a VLP-16.
        if (number.is_whole_name || areUnixSeconds(number.whole)) return value;
        return std::nullopt;
    }
    if (number.whole[0] == '0') return std::nullopt;  // padded numbers are not current times
    switch (number.whole.size()) {
        case kDigitsOfSeconds:
            return value;
        case 13:
            return 1e-3 * value;
        case 16:
            return 1e-6 * value;
        case 19:
            return 1e-9 * value;
        default:
            return std::nullopt;
    }
}

bool ascend(const std::vector<double>& numbers) {
    return std::adjacent_find(numbers.begin(), numbers.end(),
                              [](double a, double b) { return !(a < b); }) == numbers.end();
}

}  // namespace

std::vector<std::size_t> orderOfNames(const std::vector<std::string>& names) {
    std::vector<std::size_t> order(names.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t a, std::size_t b) { return names[a] < names[b]; });
    // If a counter reaches 13 digits, its numbers are still not times in milliseconds.
    const bool are_times = std::all_of(names.begin(), names.end(), [](const std::string& name) {
        return timeIn(numberIn(name)).has_value();
    });
    std::vector<double> numbers;
    std::set<std::string_view> before;
    for (const std::string& name : names) {
        const NameNumber number = numberIn(name);
        numbers.push_back(are_times ? *timeIn(number) : valueOf(number));
        if (numbers.back() < 0) return order;
        before.insert(std::string_view(name).substr(
            0, static_cast<std::size_t>(number.whole.data() - name.data())));
    }
    if (before.size() > 1) return order;
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t a, std::size_t b) { return numbers[a] < numbers[b]; });
    return order;
}

CloudTimes timesOfNames(const std::vector<std::string>& names) {
    CloudTimes times;
    for (const std::string& name : names) {
        const auto time_s = timeIn(numberIn(name));
        if (time_s && observations::isTime(*time_s)) times.times_s.push_back(*time_s);
    }
    if (times.times_s.size() == names.size() && ascend(times.times_s)) {
        times.are_of_names = true;
        times.how = "cloud times are taken from the file names";
        return times;
    }
    constexpr double kMaxNumber = 1e9;
    times.times_s.clear();
    bool are_numbers = true;
    for (const std::string& name : names) {
        const NameNumber number = numberIn(name);
        const double value = valueOf(number);
        are_numbers = are_numbers && number.mark == '\0' && value >= 0 && value < kMaxNumber;
        times.times_s.push_back(kPeriod_s * value);
    }
    if (are_numbers && ascend(times.times_s)) {
        times.how =
            "its file names are not times; assuming 0.1 s per step of the numbers in their names";
        return times;
    }
    for (std::size_t i = 0; i < names.size(); ++i) {
        times.times_s[i] = kPeriod_s * static_cast<double>(i);
    }
    times.how = "its file names are not times; assuming 0.1 s between clouds";
    return times;
}

}  // namespace hagen::recordings
