#include <zlib.h>

#include <hagen/logs/GzipInput.h>
#include <stdexcept>

namespace hagen {

GzipInput::GzipInput(const std::filesystem::path& file) : file_(gzopen(file.c_str(), "rb")) {
    if (!file_) throw std::runtime_error(file.string() + ": cannot be opened");
    gzbuffer(file_.get(), 1 << 17);
}

void GzipInput::Close::operator()(gzFile_s* file) const { gzclose_r(file); }

std::size_t GzipInput::Read(void* buffer, std::size_t count) {
    const int bytes = gzread(file_.get(), buffer, static_cast<unsigned>(count));
    if (bytes < 0) return 0;  // fault() tells why
    position_ += static_cast<std::uint64_t>(bytes);
    return static_cast<std::size_t>(bytes);
}

std::uint64_t GzipInput::packedPosition() const {
    return static_cast<std::uint64_t>(gzoffset(file_.get()));
}

std::string GzipInput::fault() const {
    int code = Z_OK;
    gzerror(file_.get(), &code);
    if (code == Z_OK || code == Z_STREAM_END) return "";
    return code == Z_BUF_ERROR ? "the file is cut off" : "the file's packed bytes are damaged";
}

std::size_t GzipInput::Write(const void*, std::size_t) {
    throw std::logic_error("an input is not written");
}
std::uint64_t GzipInput::Seek(std::int64_t, TSeekOrigin) {
    throw std::logic_error("a packed input is read from its start to its end");
}
std::uint64_t GzipInput::getTotalBytesCount() const {
    throw std::logic_error("the unpacked size of a packed input is not known");
}

}  // namespace hagen
