#include "recordings/clouds/CloudBytes.h"

#include <hagen/scan/MostReturns.h>
#include "base/FileKind.h"
#include "base/NumberText.h"
#include "base/ReadFile.h"
#include "mrpt/NumberTypes.h"
#include "recordings/Remarks.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <type_traits>

namespace hagen::recordings {
namespace {

using observations::NumberType;

bool isBlank(char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\v' || c == '\f'; }

template <class Number>
bool put(std::string_view word, std::uint8_t* to) {
    std::optional<Number> number = base::numberFrom<Number>(word);
    if constexpr (std::is_integral_v<Number>) {
        // Integers may be written as "7.0" or "1e3".
        const auto real = number ? std::nullopt : base::numberFrom<double>(word);
        const double beyond = std::ldexp(1.0, std::numeric_limits<Number>::digits);
        if (real && *real == std::floor(*real) && *real < beyond &&
            *real >= static_cast<double>(std::numeric_limits<Number>::min())) {
            number = static_cast<Number>(*real);
        }
    } else if (!number) {
        // Underflow results in 0 and overflow in infinity, as in other readers.
        const auto real = base::numberFrom<double>(word);
        if (real) number = static_cast<Number>(*real);
    }
    if (!number) return false;
    std::memcpy(to, &*number, sizeof(Number));
    return true;
}

}  // namespace

// Allows 128 bytes per point in a scan with kMaxReturns points.
constexpr std::size_t kMaxFileBytes = std::size_t{2} << 30;

Bytes readBytes(const std::filesystem::path& file) {
    std::ifstream in;
    try {
        in = base::openToRead(file);
    } catch (const std::runtime_error& e) {
        throw BrokenRecording(e.what());
    }
    in.seekg(0, std::ios::end);
    const auto size = static_cast<std::size_t>(in.tellg());
    if (size > kMaxFileBytes) {
        throw BrokenRecording(file.string() + ": is larger than 2 GiB; a cloud has at most " +
                              std::to_string(kMaxReturns) + " points");
    }
    Bytes bytes(size);
    in.seekg(0);
    in.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
    if (!in) throw BrokenRecording(file.string() + ": read error");
    return bytes;
}

void failAt(const std::filesystem::path& file, const std::string& place, const std::string& what) {
    std::string text = what;
    const auto isBinary = [](unsigned char c) { return c < 0x20 || c >= 0x7f; };
    if (!base::isText(text)) std::replace_if(text.begin(), text.end(), isBinary, '?');
    throw BrokenRecording(file.string() + ": " + place + ": " + text);
}

std::string quoted(std::string_view word) {
    const std::string_view start = word.substr(0, 40);
    return base::isText(start) ? "'" + std::string(start) + "'" : "binary data";
}

TextLines::TextLines(const Bytes& bytes) : bytes_(bytes) {
    const auto end = std::find_if(bytes.begin(), bytes.end(),
                                  [](std::uint8_t byte) { return byte == '\n' || byte == '\r'; });
    if (end == bytes.end() || *end == '\n') return;
    if (std::next(end) == bytes.end() || *std::next(end) != '\n') ending_ = '\r';
}

std::optional<std::string_view> TextLines::next() {
    if (at_ >= bytes_.size()) return std::nullopt;
    const std::uint8_t* const start = bytes_.data() + at_;
    const auto* const end =
        static_cast<const std::uint8_t*>(std::memchr(start, ending_, bytes_.size() - at_));
    std::size_t size = end == nullptr ? bytes_.size() - at_ : static_cast<std::size_t>(end - start);
    at_ += size + (end == nullptr ? 0 : 1);
    ++number_;
    if (size > 0 && start[size - 1] == '\r') --size;
    return std::string_view(reinterpret_cast<const char*>(start), size);
}

std::vector<std::string_view> wordsOf(std::string_view line) {
    std::vector<std::string_view> words;
    std::size_t at = 0;
    while (at < line.size()) {
        if (isBlank(line[at])) {
            ++at;
            continue;
        }
        const std::size_t start = at;
        while (at < line.size() && !isBlank(line[at])) ++at;
        words.push_back(line.substr(start, at - start));
    }
    return words;
}

bool putNumber(std::string_view word, NumberType type, std::uint8_t* to) {
    if (!word.empty() && word[0] == '+') word.remove_prefix(1);
    return withType(type, [&](auto number) { return put<decltype(number)>(word, to); });
}

void checkNumber(const std::filesystem::path& file, std::size_t points) {
    if (points <= kMaxReturns) return;
    throw BrokenRecording(file.string() + ": has " + std::to_string(points) +
                          " points; a scan may have at most " + std::to_string(kMaxReturns) +
                          "; is it a map of many scans?");
}

void checkRoom(const std::filesystem::path& file, std::size_t points, std::size_t bytes_per_point,
               std::size_t there) {
    if (points == 0) return;
    if (bytes_per_point > 0 && points <= there / bytes_per_point) return checkNumber(file, points);
    throw BrokenRecording(file.string() + ": the header claims " + std::to_string(points) +
                          " points of " + std::to_string(bytes_per_point) + " bytes, but " +
                          std::to_string(there) + " bytes are left; is it truncated?");
}

std::vector<std::string> remarkOnRest(std::size_t bytes) {
    if (bytes == 0) return {};
    return {counted(bytes, "byte") + " after its last point not read"};
}

}  // namespace hagen::recordings
