#include <zlib.h>

#include <hagen/logs/GzipOutput.h>

#include <cerrno>
#include <cstring>
#include <limits>
#include <stdexcept>

namespace hagen {
namespace {

[[noreturn]] void refuse(const std::filesystem::path& file) {
    throw std::runtime_error(file.string() + ": cannot be written" +
                             (errno != 0 ? std::string(": ") + std::strerror(errno) : ""));
}

}  // namespace

GzipOutput::GzipOutput(const std::filesystem::path& file)
    : path_(file), file_(gzopen(file.c_str(), "wb1")) {
    if (file_ == nullptr) refuse(path_);
    gzbuffer(file_, 1 << 17);
}

GzipOutput::~GzipOutput() {
    if (file_ != nullptr) gzclose_w(file_);
}

std::size_t GzipOutput::Write(const void* buffer, std::size_t count) {
    if (count == 0) return 0;  // gzwrite() would answer as if it had failed
    if (count > std::numeric_limits<int>::max()) {
        throw std::runtime_error(path_.string() + ": an entry part of more than 2 GiB");
    }
    errno = 0;
    if (gzwrite(file_, buffer, static_cast<unsigned>(count)) <= 0) refuse(path_);
    position_ += count;
    return count;
}

void GzipOutput::close() {
    errno = 0;
    const int code = gzclose_w(file_);
    file_ = nullptr;
    if (code != Z_OK) refuse(path_);
}

std::size_t GzipOutput::Read(void*, std::size_t) {
    throw std::logic_error("an output is not read");
}
std::uint64_t GzipOutput::Seek(std::int64_t, TSeekOrigin) {
    throw std::logic_error("a packed output is written from its start to its end");
}
std::uint64_t GzipOutput::getTotalBytesCount() const { return position_; }

}  // namespace hagen
