#include "recordings/Unpacker.h"

#include <archive.h>

#include <stdexcept>
#include <string>

namespace hagen::recordings {
namespace {

archive* newReader() {
    archive* const reader = archive_read_new();
    archive_read_support_filter_zstd(reader);
    archive_read_support_filter_lz4(reader);
    archive_read_support_filter_bzip2(reader);
    archive_read_support_format_raw(reader);
    archive_read_support_format_empty(reader);
    return reader;
}

}  // namespace

void Unpacker::Free::operator()(archive* reader) const { archive_read_free(reader); }

Unpacker::Unpacker(int descriptor) : reader_(newReader()) {
    start(archive_read_open_fd(reader_.get(), descriptor, 1 << 17));
}

Unpacker::Unpacker(const std::uint8_t* bytes, std::size_t size) : reader_(newReader()) {
    start(archive_read_open_memory(reader_.get(), bytes, size));
}

void Unpacker::start(int opened) {
    archive_entry* entry = nullptr;
    const int found =
        opened == ARCHIVE_OK ? archive_read_next_header(reader_.get(), &entry) : opened;
    is_at_end_ = found == ARCHIVE_EOF;
    if (!is_at_end_ && found != ARCHIVE_OK) {
        throw std::runtime_error(archive_error_string(reader_.get()));
    }
    if (archive_filter_code(reader_.get(), 0) == ARCHIVE_FILTER_NONE) {
        throw std::runtime_error("it is not compressed");
    }
}

std::size_t Unpacker::read(void* to, std::size_t count) {
    if (is_at_end_) return 0;
    const la_ssize_t size = archive_read_data(reader_.get(), to, count);
    if (size < 0) throw std::runtime_error(archive_error_string(reader_.get()));
    return static_cast<std::size_t>(size);
}

std::uint64_t Unpacker::consumed() const {
    return static_cast<std::uint64_t>(archive_filter_bytes(reader_.get(), -1));
}

}  // namespace hagen::recordings
