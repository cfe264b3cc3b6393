#include <hagen/base/Json.h>
#include <hagen/live/RecorderLink.h>

#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>

namespace hagen::live {
namespace {

/// Before the bytes of a packet. Both ends are of one machine and one build.
struct Header {
    std::uint64_t bytes;
    std::int64_t time_ns;
};
constexpr std::uint64_t kMostBytes = 65536;    // of a datagram
constexpr std::size_t kLongestLine = 8 << 20;  // names of more than 20 000 files

/// A peer that has ended is no reason for a signal.
bool sendAll(int socket, iovec* parts, std::size_t count) {
    msghdr message{};
    message.msg_iov = parts;
    message.msg_iovlen = count;
    while (message.msg_iovlen > 0) {
        const ssize_t result = sendmsg(socket, &message, MSG_NOSIGNAL);
        if (result < 0 && errno == EINTR) continue;
        if (result < 0) return false;
        for (auto sent = static_cast<std::size_t>(result); message.msg_iovlen > 0;) {
            iovec& part = *message.msg_iov;
            const std::size_t of_part = std::min(sent, part.iov_len);
            part.iov_base = static_cast<char*>(part.iov_base) + of_part;
            part.iov_len -= of_part;
            sent -= of_part;
            if (part.iov_len > 0) break;
            ++message.msg_iov;
            --message.msg_iovlen;
        }
    }
    return true;
}

ssize_t receive(int socket, void* to, std::size_t bytes, int flags = 0) {
    ssize_t count = 0;
    do {
        count = recv(socket, to, bytes, flags);
    } while (count < 0 && errno == EINTR);
    return count;
}

}  // namespace

bool sendPacket(int socket, const Packet& packet) {
    Header header{packet.bytes.size(), packet.time_ns};
    iovec parts[2] = {{&header, sizeof header},
                      {const_cast<std::uint8_t*>(packet.bytes.data()), packet.bytes.size()}};
    return sendAll(socket, parts, 2);
}

bool PacketReader::take(void* to, std::size_t bytes) {
    auto* at = static_cast<std::uint8_t*>(to);
    while (bytes > 0) {
        if (begin_ == end_) {
            const ssize_t count = receive(socket_, buffer_.data(), buffer_.size());
            if (count <= 0) return false;
            begin_ = 0;
            end_ = static_cast<std::size_t>(count);
        }
        const std::size_t part = std::min(bytes, end_ - begin_);
        std::memcpy(at, buffer_.data() + begin_, part);
        begin_ += part;
        at += part;
        bytes -= part;
    }
    return true;
}

bool PacketReader::next(Packet& packet) {
    Header header{};
    if (!take(&header, sizeof header) || header.bytes > kMostBytes) return false;
    packet.bytes.resize(header.bytes);
    packet.time_ns = header.time_ns;
    return take(packet.bytes.data(), packet.bytes.size());
}

void sendLine(int socket, const std::string& line) {
    std::string text = line + "\n";
    iovec part{text.data(), text.size()};
    sendAll(socket, &part, 1);
}

bool readLine(int socket, std::string& line) {
    line.clear();
    char block[4096];
    while (line.size() < kLongestLine) {
        const ssize_t there = receive(socket, block, sizeof block, MSG_PEEK);
        if (there <= 0) return false;
        const auto length = static_cast<std::size_t>(std::find(block, block + there, '\n') - block);
        const bool is_whole = length < static_cast<std::size_t>(there);
        receive(socket, block, length + (is_whole ? 1 : 0));
        line.append(block, length);
        if (is_whole) return true;
    }
    return false;
}

std::string readyLine() { return failedLine(""); }

std::string failedLine(const std::string& why) {
    return base::Json{{"failure", why}}.dump(-1, base::Json::NotUtf8::Replace);
}

std::string failureIn(const std::string& line) {
    return base::Json::parse(line).at("failure").text();
}

std::string lineOf(const Recorded& recorded) {
    base::Json files = base::Json::array();
    for (const auto& file : recorded.files) files.push_back(file.string());
    base::Json older_files = base::Json::array();
    for (const auto& file : recorded.older_files) older_files.push_back(file.string());
    return base::Json{{"turns", recorded.turns},           {"left_out", recorded.left_out},
                      {"unreadable", recorded.unreadable}, {"files", files},
                      {"older_files", older_files},        {"failure", recorded.failure}}
        .dump(-1, base::Json::NotUtf8::Replace);
}

Recorded recordedIn(const std::string& line) {
    const base::Json json = base::Json::parse(line);
    Recorded recorded;
    recorded.turns = json.at("turns").count();
    recorded.left_out = json.at("left_out").count();
    recorded.unreadable = json.at("unreadable").count();
    for (const std::string& file : json.at("files").texts()) recorded.files.emplace_back(file);
    for (const std::string& file : json.at("older_files").texts()) {
        recorded.older_files.emplace_back(file);
    }
    recorded.failure = json.at("failure").text();
    return recorded;
}

}  // namespace hagen::live
