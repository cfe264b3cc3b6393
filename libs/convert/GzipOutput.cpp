#include <isa-l/igzip_lib.h>
#include <unistd.h>

#include "base/WriteFile.h"
#include "convert/GzipOutput.h"

#include <new>

namespace hagen::convert {

void packGzipMember(const Bytes& plain, Bytes& packed) {
    // Not thread_local, because destroying it at thread exit needs memory; glibc aborts if there is
    // none.
    const std::unique_ptr<std::uint8_t[]> level_buffer(new std::uint8_t[ISAL_DEF_LVL1_DEFAULT]);
    if (plain.size() > std::numeric_limits<std::uint32_t>::max()) {
        throw std::length_error("an entry exceeds 4 GiB");
    }
    isal_zstream stream{};  // isal_deflate_stateless_init() leaves hist_bits as it is
    isal_deflate_stateless_init(&stream);
    stream.level = 1;
    stream.level_buf = level_buffer.get();
    stream.level_buf_size = ISAL_DEF_LVL1_DEFAULT;
    stream.gzip_flag = IGZIP_GZIP;
    stream.end_of_stream = 1;
    stream.next_in = const_cast<std::uint8_t*>(plain.data());
    stream.avail_in = static_cast<std::uint32_t>(plain.size());
    packed.resize(plain.size() + plain.size() / 1000 + 1000);  // enough for random bytes
    stream.next_out = packed.data();
    stream.avail_out = static_cast<std::uint32_t>(packed.size());
    if (isal_deflate_stateless(&stream) != COMP_OK) {
        throw std::logic_error("a gzip member exceeds its own bound");
    }
    packed.resize(stream.total_out);
}

GzipOutput::GzipOutput(const std::filesystem::path& file) : path_(file) {
    errno = 0;
    file_.reset(std::fopen(file.c_str(), "wb"));
    if (!file_) base::throwWriteError(path_, errno);
    std::setvbuf(file_.get(), nullptr, _IONBF, 0);  // unbuffered, because members are written whole
}

void GzipOutput::write(const Bytes& member) {
    errno = 0;
    if (std::fwrite(member.data(), 1, member.size(), file_.get()) == member.size()) {
        whole_ += static_cast<long>(member.size());
        return;
    }
    const int error = errno;
    // Readers report a truncated member as damage.
    const bool is_cut = ftruncate(fileno(file_.get()), whole_) == 0;
    errno = is_cut ? error : errno;
    base::throwWriteError(path_, errno);
}

void GzipOutput::close() {
    errno = 0;
    if (std::fclose(file_.release()) != 0) base::throwWriteError(path_, errno);
}

}  // namespace hagen::convert
