#pragma once
#include <zlib.h>

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <type_traits>
#include <vector>

#include "sensors/captures/IpFrames.h"

namespace hagen::sensors {

struct Frame {
    Bytes bytes;               ///< valid until the next frame is read
    bool is_cut = false;       ///< the capture's snap length truncated it
    int link_type = 0;         ///< LINKTYPE_* of tcpdump.org/linktypes.html
    std::int64_t time_ns = 0;  ///< since 1970; 0 if unknown
};

/// Reads the frames of a capture, which may be compressed with gzip: pcap with microseconds or
/// nanoseconds, A. Kuznetzov's modified pcap, and pcapng, in either byte order. Functions throw
/// std::runtime_error without naming the file.
class FrameFile {
 public:
    explicit FrameFile(const std::filesystem::path& file);

    /// Reads the next frame; returns false at the end.
    bool next(Frame& frame);

    /// The link type of the first interface if no interface so far has a known one.
    std::optional<int> unknownLink() const;
    /// Position of the last frame, in the uncompressed file.
    std::int64_t position() const { return position_; }
    /// Bytes of the file read so far, approximate if it is compressed.
    std::int64_t bytesRead() const;

    /// True if the file starts like a capture.
    static bool isCapture(const std::filesystem::path& file);

 private:
    struct Close {
        void operator()(gzFile file) const { gzclose(file); }
    };
    struct Interface {
        int link_type = 0;
        std::uint32_t snap_length = 0;  ///< 0: unlimited
        std::uint64_t units_per_s = 1000000;
        std::int64_t offset_s = 0;
    };

    std::uint32_t number(std::size_t at, std::size_t bytes = 4) const;
    std::size_t read(std::uint8_t* to, std::size_t size);
    bool readBody(std::size_t size, bool may_end = false);
    void skip(std::uint64_t size);
    bool nextOfPcap(Frame& frame);
    bool nextOfPcapng(Frame& frame);
    void startSection();
    void addInterface();
    void takeFrame(std::uint32_t type, Frame& frame) const;
    static std::int64_t timeOf(const Interface& interface, std::uint64_t units);

    std::unique_ptr<std::remove_pointer_t<gzFile>, Close> file_;
    bool is_pcapng_ = false, is_big_endian_ = false;
    std::size_t record_header_ = 16;
    std::vector<Interface> interfaces_;  ///< of this section; a pcap has one
    std::vector<std::uint8_t> body_;     ///< of the last record or block
    std::int64_t position_ = 0;
};

}  // namespace hagen::sensors
