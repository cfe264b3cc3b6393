#include "base/command_line/Terminal.h"

#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <iostream>
#include <streambuf>
#include <string>

namespace hagen::base {
namespace {

bool isControl(char c) { return (c >= 0 && c < 0x20) || c == 0x7f; }

std::string printable(std::string text) {
    std::replace_if(
        text.begin(), text.end(), [](char c) { return isControl(c) && c != '\n' && c != '\t'; },
        '?');
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
    std::replace_if(message.begin(), message.end(), isControl, '?');
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
        // Counts the first byte of each UTF-8 character.
        used += static_cast<std::size_t>(
            std::count_if(text.begin(), text.end(), [](char c) { return (c & 0xc0) != 0x80; }));
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
