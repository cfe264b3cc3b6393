#pragma once
// Common parts of the fuzz targets, one per file. A target accepts arbitrary bytes and either
// returns or rejects them with a std::runtime_error with a message. scripts/fuzz runs targets with
// libFuzzer; Seeds_test.cpp runs seeds and some mutations as an ordinary test.
#include <cstddef>
#include <cstring>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

namespace hagen::fuzz {

using Seeds = std::vector<std::string>;

struct Target {
    std::string name;
    void (*run)(std::string_view input);
    /// Returns valid inputs to start from.
    Seeds (*seeds)();
    /// Words of the file format for libFuzzer's dictionary.
    std::vector<std::string> words = {};
    std::size_t longest = 4096;  ///< maximum size of an input [bytes]
    bool is_bounded = true;      ///< false if mutations may exhaust memory
};

/// The targets of this program, sorted by name.
const std::vector<Target>& targets();
/// Registers a target; called at the end of its file. Returns true.
bool add(Target target);
std::vector<std::string> wordsIn(const std::string& text);

/// Thrown by require() for an error that must not occur for any input.
struct Violation : std::logic_error {
    using std::logic_error::logic_error;
};
/// Throws Violation if a condition does not hold.
void require(bool holds, const std::string& what);

/// Calls a function and returns false if it rejects its input with a std::runtime_error with a
/// message. Any other exception is a finding.
template <class Call>
bool mayRefuse(const Call& call) {
    try {
        call();
        return true;
    } catch (const std::runtime_error& e) {
        require(e.what()[0] != '\0', "an error has no message");
        return false;
    }
}

/// A temporary file with these bytes.
class InputFile {
 public:
    explicit InputFile(std::string_view bytes, const std::string& name = "input");
    ~InputFile();
    InputFile(const InputFile&) = delete;
    InputFile& operator=(const InputFile&) = delete;

    const std::filesystem::path& path() const { return path_; }

 private:
    std::filesystem::path path_;
};

/// This process's folder for input files, in memory if possible.
const std::filesystem::path& scratch();

/// Splits an input into numbers and strings. Reads zeros beyond its end.
class Parts {
 public:
    explicit Parts(std::string_view input) : rest_(input) {}

    template <class Number>
    Number number() {
        static_assert(std::is_arithmetic_v<Number> && !std::is_same_v<Number, bool>);
        Number value{};
        const std::string_view bytes = take(sizeof value);
        std::memcpy(&value, bytes.data(), bytes.size());
        return value;
    }
    /// A number in [0, `end`).
    std::size_t below(std::size_t end) { return number<std::uint8_t>() % end; }
    bool chance() { return (number<std::uint8_t>() & 1) != 0; }
    std::string_view take(std::size_t bytes) {
        const std::string_view taken = rest_.substr(0, bytes);
        rest_.remove_prefix(taken.size());
        return taken;
    }
    /// The bytes up to the next separator, which is skipped.
    std::string_view until(char separator) {
        const std::string_view taken = rest_.substr(0, rest_.find(separator));
        rest_.remove_prefix(taken.size() < rest_.size() ? taken.size() + 1 : rest_.size());
        return taken;
    }
    std::string_view rest() const { return rest_; }
    bool isAtEnd() const { return rest_.empty(); }

 private:
    std::string_view rest_;
};

/// The bytes from which Parts reads these numbers.
template <class... Number>
std::string bytesOf(Number... numbers) {
    std::string bytes;
    (bytes.append(reinterpret_cast<const char*>(&numbers), sizeof numbers), ...);
    return bytes;
}

}  // namespace hagen::fuzz
