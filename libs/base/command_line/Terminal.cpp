#include "base/command_line/Terminal.h"

#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cstdint>
#include <iostream>
#include <streambuf>
#include "base/Text.h"

namespace hagen::base {
namespace {

/// Length of the UTF-8 character at this position; 1 if the bytes are not valid UTF-8.
std::size_t bytesOfCharacter(const std::string& text, std::size_t at) {
    const std::size_t length = utf8Length(std::string_view(text).substr(at));
    return at + length > text.size() ? 1 : std::max<std::size_t>(length, 1);
}

/// True for control characters, which send commands to a terminal (on some, even single bytes from
/// 0x80 up), and for bidirectional marks, which can disguise messages.
bool isHarmful(const std::string& text, std::size_t at, std::size_t bytes) {
    const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[at + i]); };
    if (bytes == 1) {
        return (byte(0) < 0x20 && text[at] != '\n' && text[at] != '\t') || byte(0) >= 0x7f;
    }
    if (bytes == 2) return byte(0) == 0xc2 && byte(1) < 0xa0;  // U+0080 to U+009F
    const std::uint32_t code = byte(0) == 0xe2 ? byte(1) << 8 | byte(2) : 0;
    return code == 0x808e || code == 0x808f ||    // U+200E, U+200F
           (code >= 0x80a8 && code <= 0x80ae) ||  // U+2028 to U+202E
           (code >= 0x81a6 && code <= 0x81a9);    // U+2066 to U+2069
}

std::string printable(std::string text) {
    for (std::size_t at = 0; at < text.size();) {
        const std::size_t bytes = bytesOfCharacter(text, at);
        if (isHarmful(text, at, bytes)) text.replace(at, bytes, bytes, '?');
        at += bytes;
    }
    return text;
}

/// Filters text before it reaches the buffer of a standard stream.
class PrintableBuffer : public std::streambuf {
 public:
    explicit PrintableBuffer(std::streambuf* stream) : stream_(stream) {}

    void clearLine() {
        constexpr char kCommand[] = "\r\033[K";
        stream_->sputn(kCommand, sizeof kCommand - 1);
    }

 protected:
    int_type overflow(int_type c) override {
        if (traits_type::eq_int_type(c, traits_type::eof())) return traits_type::not_eof(c);
        return stream_->sputc(printable({traits_type::to_char_type(c)})[0]);
    }
    std::streamsize xsputn(const char* text, std::streamsize size) override {
        return stream_->sputn(printable({text, static_cast<std::size_t>(size)}).data(), size);
    }
    int sync() override { return stream_->pubsync(); }

 private:
    std::streambuf* stream_;
};

}  // namespace

void keepTerminalSafe() {
    // Never destroyed, because messages may be printed until the process ends.
    static auto* const out = new PrintableBuffer(std::cout.rdbuf());
    static auto* const err = new PrintableBuffer(std::cerr.rdbuf());
    std::cout.rdbuf(out);
    std::cerr.rdbuf(err);
}

std::string oneLine(std::string message) {
    const auto is_control = [](unsigned char c) { return c < 0x20 || c == 0x7f; };
    std::replace_if(message.begin(), message.end(), is_control, '?');
    return message;
}

std::ostream& clearLine(std::ostream& out) {
    if (auto* const buffer = dynamic_cast<PrintableBuffer*>(out.rdbuf())) {
        buffer->clearLine();
        return out;
    }
    return out << "\r\033[K";
}

std::size_t terminalColumns() {
    winsize size{};
    const bool is_known = ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0;
    return is_known ? size.ws_col : 80;
}

std::string lineOf(const std::vector<std::string>& parts, std::size_t columns) {
    std::string line;
    std::size_t used = 0;
    for (const std::string& part : parts) {
        const std::string text = (line.empty() ? "" : " | ") + part;
        for (std::size_t at = 0; at < text.size(); at += bytesOfCharacter(text, at)) ++used;
        // Some terminals wrap after the last column.
        if (used < columns) {
            line += text;
        } else {
            return line.empty() ? part.substr(0, columns - 1) : line;
        }
    }
    return line;
}

}  // namespace hagen::base
