#include <hagen/command_line/Terminal.h>

#include <algorithm>
#include <iostream>
#include <streambuf>
#include <string>

namespace hagen::command_line {
namespace {

char printable(char c) {
    const auto byte = static_cast<unsigned char>(c);
    const bool is_control = (byte < 0x20 && c != '\n' && c != '\t') || byte == 0x7f;
    return is_control ? '?' : c;
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
        return stream_->sputc(printable(traits_type::to_char_type(c)));
    }
    std::streamsize xsputn(const char* text, std::streamsize size) override {
        std::string safe(text, static_cast<std::size_t>(size));
        std::transform(safe.begin(), safe.end(), safe.begin(), printable);
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

std::ostream& clearLine(std::ostream& out) {
    if (auto* const buffer = dynamic_cast<PrintableBuffer*>(out.rdbuf())) {
        buffer->clearLine();
        return out;
    }
    return out << "\r\033[K";
}

}  // namespace hagen::command_line
