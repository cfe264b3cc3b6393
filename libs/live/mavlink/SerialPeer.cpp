#include <fcntl.h>
#include <poll.h>
#include <sys/ioctl.h>
#include <termios.h>
#include <unistd.h>

#include <cerrno>
#include <iterator>
#include <optional>
#include <stdexcept>
#include <thread>

#include "live/mavlink/Peers.h"

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

constexpr std::chrono::milliseconds kOpenEvery{500};    // time between attempts to reopen
constexpr std::chrono::milliseconds kTakesWithin{300};  // longest time without progress
constexpr std::chrono::milliseconds kStuckFor{1000};    // duration of the error report

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
        if (!isOpen()) return false;
        dropOld();
        if (!sendRest()) return false;
        const ssize_t sent = write(line_, bytes.data(), bytes.size());
        if (sent < 0) {
            if (errno != EAGAIN && errno != EINTR) leave(errno);
            return false;
        }
        // The rest of a partly written message is sent before the next message.
        rest_.assign(bytes.begin() + sent, bytes.end());
        noteWaiting();
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
    std::string name() const override { return device_; }

    std::string trouble() const override {
        if (line_ < 0) return device_ + ": cannot be used: " + errorText(error_);
        return isStuck() ? device_ + ": does not accept data" : "";
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
        cfmakeraw(&settings);  // 8N1 without character translation
        settings.c_cflag |= CLOCAL | CREAD;
        settings.c_cflag &= ~static_cast<tcflag_t>(CRTSCTS | CSTOPB);
        settings.c_cc[VMIN] = 1;
        settings.c_cc[VTIME] = 0;
        cfsetispeed(&settings, speed_);
        cfsetospeed(&settings, speed_);
        if (tcsetattr(line_, TCSANOW, &settings) != 0) return leave(errno);
        tcflush(line_, TCIOFLUSH);
        waiting_ = 0;
        moved_ = Clock::now();
    }
    void leave(int error) {
        // Discards unsent data, for which close() would wait.
        if (line_ >= 0 && isStuck()) tcflush(line_, TCOFLUSH);
        if (line_ >= 0) close(line_);
        line_ = -1;
        error_ = error;
        rest_.clear();
    }
    bool sendRest() {
        if (rest_.empty()) return true;
        const ssize_t sent = write(line_, rest_.data(), rest_.size());
        if (sent < 0 && errno != EAGAIN && errno != EINTR) leave(errno);
        if (sent > 0) {
            rest_.erase(rest_.begin(), rest_.begin() + sent);
            noteWaiting();
        }
        return line_ >= 0 && rest_.empty();
    }

    bool isStuck() const { return stuck_ && Clock::now() - *stuck_ <= kStuckFor; }
    int waitingBytes() const {
        int bytes = 0;
        return ioctl(line_, TIOCOUTQ, &bytes) == 0 ? bytes : 0;
    }
    /// Called after the line accepted bytes. Some drivers (pseudoterminals) always report an empty
    /// queue; each accepted write then counts as progress.
    void noteWaiting() {
        waiting_ = waitingBytes();
        if (waiting_ == 0) moved_ = Clock::now();
    }
    /// Drops queued messages of a stuck line, because they would be sent late.
    void dropOld() {
        const int waiting = waitingBytes();
        if (waiting < waiting_ || (waiting == 0 && !isFull())) moved_ = Clock::now();
        waiting_ = waiting;
        if (Clock::now() - moved_ <= kTakesWithin) return;
        stuck_ = moved_ = Clock::now();
        tcflush(line_, TCOFLUSH);
        rest_.clear();
        waiting_ = 0;
    }
    /// Whether the line currently accepts no data.
    bool isFull() const {
        pollfd line{line_, POLLOUT, 0};
        return poll(&line, 1, 0) == 0;
    }

    std::string device_;
    speed_t speed_;
    int line_ = -1, error_ = 0;
    Clock::time_point tried_;
    std::vector<std::uint8_t> rest_;
    int waiting_ = 0;          ///< size of the output queue at the last check
    Clock::time_point moved_;  ///< last time the queue shrank or was empty
    std::optional<Clock::time_point> stuck_;
};

}  // namespace

bool isBaud(int baud) { return speedOf(baud) != nullptr; }

std::unique_ptr<Peer> openSerial(const PeerAddress& address) {
    return std::make_unique<SerialPeer>(address);
}

}  // namespace hagen::mavlink
