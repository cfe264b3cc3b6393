#pragma once
#include <hagen/sensors/Datagram.h>

#include <cstddef>
#include <filesystem>
#include <functional>
#include <memory>
#include <stdexcept>

namespace hagen::sensors {

/// A truncated capture, or an unreadable frame. The message names the file, the frame and its byte
/// offset.
struct BrokenCapture : std::runtime_error {
    using std::runtime_error::runtime_error;
};

/// Counts of the frames in a capture. Each frame is counted once, except fragments of complete
/// datagrams.
struct FrameCounts {
    std::size_t frames = 0;
    std::size_t datagrams = 0;       ///< complete UDP datagrams
    std::size_t fragments = 0;       ///< frames with a fragment of a datagram
    std::size_t fragments_lost = 0;  ///< fragments of incomplete datagrams
    std::size_t other_traffic = 0;   ///< frames that are not UDP over IP
    std::size_t cut_frames = 0;      ///< frames truncated by the capture's snap length
    std::size_t tagged = 0;          ///< frames with a VLAN tag
};

/// True if the file starts like a capture (.pcap or .pcapng, also gzipped, or .lvx2), regardless of
/// its name.
bool isCapture(const std::filesystem::path& file);

/// Reads the UDP datagrams of a capture one by one: Ethernet (with VLAN tags), Linux "any" device
/// and raw IP, which may differ between the interfaces of a pcapng file. The packages of a Livox
/// Viewer 2 recording (.lvx2) are frames with a datagram. Memory use does not grow with the file.
class CaptureFile {
 public:
    /// Throws BrokenCapture naming the file if it is not a readable capture.
    explicit CaptureFile(const std::filesystem::path& file);
    ~CaptureFile();

    /// Reads the next datagram; returns false at the end. Throws BrokenCapture.
    bool next(Datagram& datagram);

    /// Calls `check` after every kFramesPerCheck frames, because next() may search the whole file
    /// for a datagram. Exceptions of `check` leave next(), which can be called again.
    void checkWhileReading(const std::function<void()>& check);
    static constexpr std::size_t kFramesPerCheck = 1024;

    /// Complete when next() has returned false or thrown.
    const FrameCounts& counts() const;
    /// Fraction of the file read so far, 0 ... 1.
    double fractionRead() const;

 private:
    struct Reader;
    std::unique_ptr<Reader> reader_;
};

}  // namespace hagen::sensors
