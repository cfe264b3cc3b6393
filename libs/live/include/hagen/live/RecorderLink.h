#pragma once
#include <hagen/live/PacketQueue.h>
#include <hagen/live/Recording.h>

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

/// What a session and its recorder say to each other through a socket: packets there, two lines of
/// JSON back. The recorder says that it is ready, or why not; and at its end what became of it. It
/// ends when the socket does, however the session ended.
namespace hagen::live {

/// Sends a packet: its bytes and its time. Waits for the recorder; false if that has ended.
bool sendPacket(int socket, const Packet& packet);

/// The packets that come from a session.
class PacketReader {
 public:
    explicit PacketReader(int socket) : socket_(socket), buffer_(kBuffer) {}

    /// Reads the next packet, without arrival and addresses; false at the end. A packet of which a
    /// part is missing is none.
    bool next(Packet& packet);

 private:
    static constexpr std::size_t kBuffer = 1 << 18;
    bool take(void* to, std::size_t bytes);

    int socket_;
    std::vector<std::uint8_t> buffer_;
    std::size_t begin_ = 0, end_ = 0;
};

/// Sends a line; what cannot be sent is lost.
void sendLine(int socket, const std::string& line);
/// Reads a line, without its end. False where there is no whole one.
bool readLine(int socket, std::string& line);

std::string readyLine();
/// The same with the reason why it is not.
std::string failedLine(const std::string& why);
/// The reason; empty: it is ready. Throws std::runtime_error if it is no such line.
std::string failureIn(const std::string& line);

std::string lineOf(const Recorded& recorded);
/// Throws std::runtime_error if it is no such line.
Recorded recordedIn(const std::string& line);

}  // namespace hagen::live
