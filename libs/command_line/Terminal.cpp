#include <hagen/command_line/Terminal.h>

#include <algorithm>
#include <iostream>
#include <streambuf>
#include <string>

namespace hagen::command_line {
namespace {

/// Replaces what commands a terminal, byte by byte: control characters, also those from 0x80 on
/// (such as U+009B, which begins commands) in UTF-8, and bytes that are no UTF-8, which are control
/// characters of terminals with 8 bits.
class Utf8Filter {
 public:
    char printable(char c) {
        const auto byte = static_cast<unsigned char>(c);
        if (byte < 0x80) {
            following_ = 0;
            const bool is_control = (byte < 0x20 && c != '\n' && c != '\t') || byte == 0x7f;
            return is_control ? '?' : c;
        }
        if (byte < 0xc0) {
            const bool is_control = following_ == 0 || (is_latin_ && byte < 0xa0);
            following_ = std::max(0, following_ - 1);
            return is_control ? '?' : c;
        }
        const bool is_first = byte >= 0xc2 && byte < 0xf5;
        following_ = !is_first ? 0 : byte < 0xe0 ? 1 : byte < 0xf0 ? 2 : 3;
        is_latin_ = byte == 0xc2;
        return is_first ? c : '?';
    }

 private:
    int following_ = 0;      ///< bytes of the character that are still to come
    bool is_latin_ = false;  ///< it is one from U+0080 to U+00BF
};

/// Passes text on to the buffer of a standard stream.
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
        return stream_->sputc(Utf8Filter().printable(traits_type::to_char_type(c)));
    }
    std::streamsize xsputn(const char* text, std::streamsize size) override {
        std::string safe(text, static_cast<std::size_t>(size));
        Utf8Filter filter;  // several threads may print
        for (char& c : safe) c = filter.printable(c);
        return stream_->sputn(safe.data(), size);
    }
    int sync() override { return stream_->pubsync(); }

 private:
    std::streambuf* stream_;
};

}  // namespace

void keepTerminalSafe() {
    // Never destroyed: messages may be printed until the process ends.
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

}  // namespace hagen::command_line
