#include <hagen/sensors/CaptureFile.h>

#include <arpa/inet.h>
#include "base/ReadFile.h"

#include <algorithm>
#include <array>
#include <bitset>
#include <list>

#include "sensors/captures/FrameFile.h"
#include "sensors/captures/IpFrames.h"
#include "sensors/livox/Lvx2File.h"

namespace hagen::sensors {
namespace {

/// Reassembles datagrams from IP fragments in arbitrary order. Keeps a limited number of incomplete
/// datagrams and evicts the oldest.
class Fragments {
 public:
    /// Adds a fragment. If it completes a datagram, returns the content, which is valid until the
    /// next call; otherwise returns nothing.
    Bytes add(const IpPacket& fragment) {
        constexpr std::size_t kMaxBytes = 65535;
        const std::size_t end = fragment.offset + fragment.content.size;
        const bool is_whole_units = !fragment.has_more || fragment.content.size % kUnit == 0;
        if (end > kMaxBytes || fragment.content.size == 0 || !is_whole_units) {
            ++lost_;
            return {};
        }
        const auto at = find(fragment);
        Open& open = *at;
        ++open.fragments;
        if (open.bytes.size() < end) open.bytes.resize(end);
        std::copy_n(fragment.content.data, fragment.content.size,
                    open.bytes.begin() + fragment.offset);
        for (std::size_t byte = fragment.offset; byte < end; byte += kUnit) {
            open.has_unit.set(byte / kUnit);
        }
        if (!fragment.has_more) open.size = end;
        if (!isComplete(open)) return {};
        complete_ = std::move(open.bytes);
        complete_.resize(open.size);
        open_.erase(at);
        return {complete_.data(), complete_.size()};
    }

    /// Number of invalid or evicted fragments. giveUpAll() adds those of incomplete datagrams.
    std::size_t lost() const { return lost_; }
    void giveUpAll() {
        for (const Open& open : open_) lost_ += open.fragments;
        open_.clear();
    }

 private:
    static constexpr std::size_t kMaxOpen = 16;
    static constexpr std::size_t kUnit = 8;  ///< unit of fragment offsets, bytes
    struct Open {
        IpAddress from_ip, to_ip;
        std::uint32_t id;
        std::vector<std::uint8_t> bytes;
        std::bitset<65536 / kUnit> has_unit;
        std::size_t size = 0;  ///< size of the datagram; 0 until its last fragment arrives
        std::size_t fragments = 0;
    };
    std::list<Open>::iterator find(const IpPacket& fragment) {
        const auto found = std::find_if(open_.begin(), open_.end(), [&](const Open& open) {
            return open.id == fragment.id && open.from_ip == fragment.from_ip &&
                   open.to_ip == fragment.to_ip;
        });
        if (found != open_.end()) return found;
        if (open_.size() == kMaxOpen) {
            lost_ += open_.front().fragments;
            open_.pop_front();
        }
        Open& open = open_.emplace_back();
        open.from_ip = fragment.from_ip;
        open.to_ip = fragment.to_ip;
        open.id = fragment.id;
        return std::prev(open_.end());
    }
    static bool isComplete(const Open& open) {
        if (open.size == 0) return false;
        for (std::size_t unit = 0; unit * kUnit < open.size; ++unit) {
            if (!open.has_unit[unit]) return false;
        }
        return true;
    }

    std::list<Open> open_;  ///< oldest first
    std::vector<std::uint8_t> complete_;
    std::size_t lost_ = 0;
};

}  // namespace

std::string ipText(const IpAddress& ip) {
    in6_addr address{};
    for (std::size_t i = 0; i < 8; ++i) {
        address.s6_addr[i] = static_cast<std::uint8_t>(ip.high >> (56 - 8 * i));
        address.s6_addr[8 + i] = static_cast<std::uint8_t>(ip.low >> (56 - 8 * i));
    }
    std::array<char, INET6_ADDRSTRLEN> text{};
    inet_ntop(AF_INET6, &address, text.data(), text.size());
    constexpr std::size_t kPrefix = 7;  // "::ffff:"
    return text.data() + (ip.isIpv4() ? kPrefix : 0);
}

bool isCapture(const std::filesystem::path& file) {
    return FrameFile::isCapture(file) || Lvx2File::isLvx2(file);
}

struct CaptureFile::Reader {
    std::filesystem::path file;
    std::optional<FrameFile> capture;
    std::optional<Lvx2File> lvx2;  ///< read instead of `capture`
    double file_bytes;
    FrameCounts counts;
    Fragments fragments;
    std::function<void()> check;

    explicit Reader(const std::filesystem::path& name) : file(name) {
        base::checkIsFile(file);
        try {
            if (Lvx2File::isLvx2(file)) {
                lvx2.emplace(file);
            } else {
                capture.emplace(file);
            }
            file_bytes = static_cast<double>(std::filesystem::file_size(file));
        } catch (const std::runtime_error& e) {
            throw BrokenCapture(file.string() + ": cannot be read as a capture: " + e.what());
        }
        if (capture) checkLink();
    }

    /// Counts the fragments of datagrams that are still incomplete at the end.
    void end() {
        fragments.giveUpAll();
        counts.fragments_lost = fragments.lost();
    }

    /// Reads the next frame, or package of a Livox Viewer 2 recording, from its file; returns false
    /// at the end.
    template <class File, class Item>
    bool readNext(File& from, Item& item) {
        try {
            if (from.next(item)) return true;
        } catch (const std::runtime_error& e) {
            end();
            throw BrokenCapture(file.string() + ": frame " + std::to_string(counts.frames) +
                                " at byte " + std::to_string(from.position()) +
                                " cannot be read: " + e.what());
        }
        end();
        return false;
    }

    /// Throws BrokenCapture if the frames of all interfaces are unreadable.
    void checkLink() const {
        const auto link = capture->unknownLink();
        if (!link) return;
        throw BrokenCapture(file.string() + ": was captured on a link of type " +
                            std::to_string(*link) +
                            ", which is not supported; known: Ethernet, Linux 'any' and raw IP");
    }

    /// Returns the datagram that this packet completes, with its UDP header; empty if the datagram
    /// is still incomplete.
    Bytes wholeOf(const IpPacket& packet) {
        if (!packet.isFragment()) return packet.content;
        ++counts.fragments;
        return fragments.add(packet);
    }

    /// Parses a complete datagram; returns false if it is truncated.
    static bool take(const IpPacket& packet, Bytes whole, const Frame& frame, Datagram& datagram) {
        if (whole.size < kUdpHeader) return false;
        const std::size_t size = whole.at16(4);
        if (size < kUdpHeader || size > whole.size) return false;
        datagram.time_ns = frame.time_ns;
        datagram.from_ip = packet.from_ip;
        datagram.to_ip = packet.to_ip;
        datagram.from_port = static_cast<std::uint16_t>(whole.at16(0));
        datagram.to_port = static_cast<std::uint16_t>(whole.at16(2));
        datagram.bytes = whole.data + kUdpHeader;
        datagram.size = size - kUdpHeader;
        return true;
    }
};

CaptureFile::CaptureFile(const std::filesystem::path& file)
    : reader_(std::make_unique<Reader>(file)) {}

CaptureFile::~CaptureFile() = default;

bool CaptureFile::next(Datagram& datagram) {
    Reader& r = *reader_;
    Frame frame;
    while (true) {
        const std::size_t frames = r.counts.frames;
        if (r.check && frames > 0 && frames % kFramesPerCheck == 0) r.check();
        if (r.lvx2) {
            if (!r.readNext(*r.lvx2, datagram)) return false;
            ++r.counts.frames;
            ++r.counts.datagrams;
            return true;
        }
        if (!r.readNext(*r.capture, frame)) return false;
        r.checkLink();
        ++r.counts.frames;
        const IpPacket packet = readFrame(frame.link_type, frame.bytes);
        r.counts.tagged += packet.is_tagged;
        if (packet.kind == IpPacket::Kind::Other) {
            ++r.counts.other_traffic;
        } else if (packet.kind == IpPacket::Kind::Cut || frame.is_cut) {
            ++r.counts.cut_frames;
        } else if (const Bytes whole = r.wholeOf(packet); whole.data != nullptr) {
            if (Reader::take(packet, whole, frame, datagram)) {
                ++r.counts.datagrams;
                return true;
            }
            ++r.counts.cut_frames;
        }
    }
}

void CaptureFile::checkWhileReading(const std::function<void()>& check) { reader_->check = check; }

const FrameCounts& CaptureFile::counts() const { return reader_->counts; }

double CaptureFile::fractionRead() const {
    const auto byte = static_cast<double>(reader_->lvx2 ? reader_->lvx2->position()
                                                        : reader_->capture->bytesRead());
    return reader_->file_bytes > 0 ? std::min(byte / reader_->file_bytes, 1.0) : 1.0;
}

}  // namespace hagen::sensors
