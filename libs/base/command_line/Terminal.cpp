#include <hagen/base/Terminal.h>

#include <algorithm>
#include <iostream>
#include <streambuf>
#include <string>

namespace hagen::base {
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

/// Replaces marks that reverse or break what follows on a line: a message could be disguised.
/// U+0080 to U+009F, U+200E, U+200F, U+2028 to U+202E and U+2066 to U+2069, in UTF-8.
void hideOverrides(std::string& text) {
    const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
    for (std::size_t i = 0; i + 1 < text.size(); ++i) {
        if (byte(i) == 0xc2 && byte(i + 1) >= 0x80 && byte(i + 1) < 0xa0) {
            text.replace(i, 2, "??");
        } else if (byte(i) == 0xe2 && i + 2 < text.size()) {
            const unsigned char last = byte(i + 2);
            const bool is_mark = (byte(i + 1) == 0x80 && (last == 0x8e || last == 0x8f ||  //
                                                          (last >= 0xa8 && last <= 0xae))) ||
                                 (byte(i + 1) == 0x81 && last >= 0xa6 && last <= 0xa9);
            if (is_mark) text.replace(i, 3, "???");
        }
    }
}

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
        hideOverrides(safe);
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

}  // namespace hagen::base
