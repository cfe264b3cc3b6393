#include <libdeflate.h>
#include <unistd.h>

#include "base/WriteFile.h"
#include "convert/GzipOutput.h"

#include <new>

namespace hagen::convert {
namespace {

constexpr int kGzipLevel = 1;

struct FreeCompressor {
    void operator()(libdeflate_compressor* compressor) const {
        libdeflate_free_compressor(compressor);
    }
};

}  // namespace

void packGzipMember(const Bytes& plain, Bytes& packed) {
    // Not thread_local, because destroying it at thread exit needs memory; glibc aborts if there is
    // none.
    const std::unique_ptr<libdeflate_compressor, FreeCompressor> compressor(
        libdeflate_alloc_compressor(kGzipLevel));
    if (!compressor) throw std::bad_alloc();
    const std::size_t bound = libdeflate_gzip_compress_bound(compressor.get(), plain.size());
    if (packed.size() < bound) packed.resize(bound);
    const std::size_t size = libdeflate_gzip_compress(compressor.get(), plain.data(), plain.size(),
                                                      packed.data(), packed.size());
    if (size == 0) throw std::logic_error("a gzip member exceeds its own bound");
    packed.resize(size);
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
