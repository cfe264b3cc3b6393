#pragma once
#include <mrpt/io/CStream.h>
#include <filesystem>
#include <memory>
#include <string>

namespace hagen::logs {

/// Reads a file that is gzipped, in one member or several, or not at all, and knows whether it
/// ended whole. MRPT's own stream takes a gzip file that is cut off for one that ends there.
class GzipInput : public mrpt::io::CStream {
 public:
    /// Throws std::runtime_error, naming the file, where it cannot be opened.
    explicit GzipInput(const std::filesystem::path& file);
    ~GzipInput() override;

    /// Gives what there is, up to `count` bytes.
    std::size_t Read(void* buffer, std::size_t count) override;
    /// Unpacked bytes read so far.
    std::uint64_t getPosition() const override { return position_; }
    /// Bytes of the file taken so far.
    std::uint64_t packedPosition() const;

    /// What is wrong with the file where no more can be read: it is cut off, or its bytes are
    /// damaged. Empty where it ended as it should.
    std::string fault() const;

    // Not of an input that is read once, from its start to its end.
    std::size_t Write(const void* buffer, std::size_t count) override;
    std::uint64_t Seek(std::int64_t offset, TSeekOrigin origin) override;
    std::uint64_t getTotalBytesCount() const override;

 private:
    struct Stream;
    std::unique_ptr<Stream> stream_;
    std::uint64_t position_ = 0;
};

}  // namespace hagen::logs
