#include <fcntl.h>
#include <poll.h>
#include <termios.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <iterator>
#include <stdexcept>
#include <thread>

#include "Peers.h"

namespace hagen::mavlink {
namespace {

struct Speed {
    int baud;
    speed_t value;
};
constexpr Speed kSpeeds[] = {{9600, B9600},       {19200, B19200},     {38400, B38400},
                             {57600, B57600},     {115200, B115200},   {230400, B230400},
                             {460800, B460800},   {500000, B500000},   {576000, B576000},
                             {921600, B921600},   {1000000, B1000000}, {1500000, B1500000},
                             {2000000, B2000000}, {3000000, B3000000}};

const Speed* speedOf(int baud) {
    const auto* const found = std::find_if(std::begin(kSpeeds), std::end(kSpeeds),
                                           [&](const Speed& each) { return each.baud == baud; });
    return found == std::end(kSpeeds) ? nullptr : found;
}

constexpr std::chrono::milliseconds kOpenEvery{500};  // a line that was unplugged

class SerialPeer : public Peer {
 public:
    explicit SerialPeer(const PeerAddress& address)
        : device_(address.device), speed_(speedOf(address.baud)->value) {
        tryToOpen();
        if (line_ < 0) throw std::runtime_error(trouble());
    }
    ~SerialPeer() override { leave(0); }
    SerialPeer(const SerialPeer&) = delete;
    SerialPeer& operator=(const SerialPeer&) = delete;

    bool send(const std::vector<std::uint8_t>& bytes) override {
        if (!isOpen() || !sendRest()) return false;
        const ssize_t sent = write(line_, bytes.data(), bytes.size());
        if (sent < 0) {
            if (errno != EAGAIN && errno != EINTR) leave(errno);
            return false;
        }
        // The rest of a message that has begun follows before the next one.
        rest_.assign(bytes.begin() + sent, bytes.end());
        return true;
    }

    std::size_t receive(std::uint8_t* buffer, std::size_t size, double longest_s) override {
        if (!isOpen()) {
            std::this_thread::sleep_for(std::chrono::milliseconds(waitMs(longest_s)));
            return 0;
        }
        pollfd waits{line_, POLLIN, 0};
        if (poll(&waits, 1, waitMs(longest_s)) <= 0) return 0;
        const ssize_t got = read(line_, buffer, size);
        if (got > 0) return static_cast<std::size_t>(got);
        if (got == 0) leave(ENODEV);
        if (got < 0 && errno != EAGAIN && errno != EINTR) leave(errno);
        return 0;
    }

    bool hasDatagrams() const override { return false; }

    std::string trouble() const override {
        return line_ >= 0 ? "" : device_ + ": cannot be used: " + errorText(error_);
    }

 private:
    bool isOpen() {
        if (line_ < 0 && Clock::now() - tried_ > kOpenEvery) tryToOpen();
        return line_ >= 0;
    }
    void tryToOpen() {
        tried_ = Clock::now();
        line_ = ::open(device_.c_str(), O_RDWR | O_NOCTTY | O_NONBLOCK | O_CLOEXEC);
        if (line_ < 0) {
            error_ = errno;
            return;
        }
        termios settings{};
        if (tcgetattr(line_, &settings) != 0) return leave(errno);
        cfmakeraw(&settings);  // 8N1, nothing is translated
        settings.c_cflag |= CLOCAL | CREAD;
        settings.c_cflag &= ~static_cast<tcflag_t>(CRTSCTS | CSTOPB);
        settings.c_cc[VMIN] = 1;
        settings.c_cc[VTIME] = 0;
        cfsetispeed(&settings, speed_);
        cfsetospeed(&settings, speed_);
        if (tcsetattr(line_, TCSANOW, &settings) != 0) return leave(errno);
        tcflush(line_, TCIOFLUSH);
    }
    void leave(int error) {
        if (line_ >= 0) close(line_);
        line_ = -1;
        error_ = error;
        rest_.clear();
    }
    bool sendRest() {
        if (rest_.empty()) return true;
        const ssize_t sent = write(line_, rest_.data(), rest_.size());
        if (sent < 0 && errno != EAGAIN && errno != EINTR) leave(errno);
        if (sent > 0) rest_.erase(rest_.begin(), rest_.begin() + sent);
        return line_ >= 0 && rest_.empty();
    }

    std::string device_;
    speed_t speed_;
    int line_ = -1, error_ = 0;
    Clock::time_point tried_;
    std::vector<std::uint8_t> rest_;
};

}  // namespace

bool isBaud(int baud) { return speedOf(baud) != nullptr; }

std::unique_ptr<Peer> openSerial(const PeerAddress& address) {
    return std::make_unique<SerialPeer>(address);
}

}  // namespace hagen::mavlink
