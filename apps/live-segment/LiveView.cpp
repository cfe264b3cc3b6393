#include "LiveView.h"

#include <httplib.h>
#include <pthread.h>
#include <sched.h>

#include <hagen/live/PacketSource.h>
#include <hagen/scan/Angle.h>
#include <atomic>
#include <chrono>
#include <cmath>
#include <condition_variable>
#include <deque>
#include <functional>
#include <mutex>
#include <new>
#include <sstream>
#include <stdexcept>
#include <thread>
#include <utility>

#include "base/NumberText.h"
#include "base/view/ViewPage.h"

namespace hagen {
namespace {

using base::Json;
using namespace std::chrono_literals;

constexpr auto kPeriod = 100ms;
constexpr std::size_t kMaxClients = 16;  // each has a thread
constexpr int kFastDeflate = 1;
constexpr double kFrame_s = 0.1;  // shown at once, without a rotating head

/// Runs the calling thread, and the threads that it starts, only if nothing else wants to run.
void yieldToOthers() {
    const sched_param none{};
    pthread_setschedparam(pthread_self(), SCHED_IDLE, &none);
}

/// A copy of a labelled sector.
struct Sector {
    std::vector<float> x_m, y_m, z_m, intensity;
    std::vector<Label> label;
    double sweep_rad, time_s;
};

std::shared_ptr<const Sector> copyOf(const live::LabelledSector& sector) {
    const Scan& scan = sector.returns;
    return std::make_shared<const Sector>(Sector{
        scan.x_m, scan.y_m, scan.z_m, scan.intensity, sector.label,
        sector.sweep ? sector.sweep->to_rad - sector.sweep->from_rad : 0, sector.last_time_s});
}

/// Blocks the accepting thread while all connections are in use, so that further clients wait in
/// the kernel's queue and use no file descriptors.
class BoundedPool : public httplib::TaskQueue {
 public:
    explicit BoundedPool(std::size_t connections) : pool_(connections), free_(connections) {}
    // bool in newer versions of cpp-httplib, else void.
    decltype(std::declval<TaskQueue&>().enqueue({})) enqueue(std::function<void()> serve) override {
        std::unique_lock lock(mutex_);
        freed_.wait(lock, [this] { return free_ > 0; });
        --free_;
        return pool_.enqueue([this, serve = std::move(serve)] {
            serve();
            const std::lock_guard done(mutex_);
            ++free_;
            freed_.notify_one();
        });
    }

    void shutdown() override { pool_.shutdown(); }

 private:
    httplib::ThreadPool pool_;
    std::mutex mutex_;
    std::condition_variable freed_;
    std::size_t free_;
};

Json jsonOf(const live::Directions& directions, double begin_rad, double now_s) {
    Json distances = Json::array(), states = Json::array(), ages = Json::array();
    for (const live::Direction& each : directions) {
        const bool is_known = each.state != live::DirectionState::Unknown;
        const bool is_occupied = each.state == live::DirectionState::Obstacle;
        distances.push_back(is_occupied ? Json(static_cast<double>(each.distance_m)) : Json());
        states.push_back(is_occupied ? "occupied" : is_known ? "free" : "unknown");
        ages.push_back(is_known ? now_s - each.time_s : 0);
    }
    return {{"begin_deg", degrees(begin_rad)},
            {"distance_m", distances},
            {"state", states},
            {"age_s", ages}};
}

live::Address addressOf(const std::string& text) {
    try {
        return live::parseAddress(text.find(':') == std::string::npos ? "127.0.0.1:" + text : text);
    } catch (const std::runtime_error& e) {
        throw std::runtime_error("--view " + text + ": " + e.what());
    }
}

}  // namespace

class LiveView::Work {
 public:
    explicit Work(Settings settings) : settings_(std::move(settings)) {
        server_.new_task_queue = [] { return new BoundedPool(kMaxClients); };
        server_.set_socket_options([](int socket) {  // by default, programs may share a port
            const int yes = 1;
            setsockopt(socket, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof yes);
        });
        server_.set_keep_alive_timeout(1);
        server_.set_read_timeout(2s);
        server_.set_write_timeout(2s);
        server_.set_payload_max_length(0);
        server_.Get("/", [this](const httplib::Request&, httplib::Response& response) {
            response.set_content(page(), "text/html");
        });
        server_.Get("/favicon.ico", [](const httplib::Request&, httplib::Response& response) {
            response.status = 204;
        });
        server_.Get("/events", [this](const httplib::Request&, httplib::Response& response) {
            stream(response);
        });
        const live::Address address = addressOf(settings_.address);
        const std::string host =
            std::to_string(address.ip >> 24) + "." + std::to_string(address.ip >> 16 & 0xff) + "." +
            std::to_string(address.ip >> 8 & 0xff) + "." + std::to_string(address.ip & 0xff);
        if (!server_.bind_to_port(host, address.port)) {
            throw std::runtime_error("--view: cannot listen on " + host + ":" +
                                     std::to_string(address.port) + "; is the port in use?");
        }
    }

    ~Work() {
        is_at_end_ = true;
        next_.notify_all();
        // Before the server runs, stop() has no effect.
        while (server_thread_.joinable() && !server_.is_running() && !has_served_) {
            std::this_thread::sleep_for(1ms);
        }
        server_.stop();
        if (server_thread_.joinable()) server_thread_.join();
        if (frame_thread_.joinable()) frame_thread_.join();
    }

    void begin(const SensorModel& sensor, const Options& options) {
        distances_.emplace(sensor, settings_.directions);
        zone_m_ = options.zone_m;
        server_thread_ = std::thread([this] {
            yieldToOthers();
            server_.listen_after_bind();
            has_served_ = true;
        });
        frame_thread_ = std::thread([this] {
            yieldToOthers();
            makeFrames();
        });
    }

    void take(const live::LabelledSector& sector) {
        if (clients_ == 0) return;
        if (!settings_.directions_sent) distances_->take(sector);
        sectors_.push_back(copyOf(sector));
        sweep_rad_ += sectors_.back()->sweep_rad;
        while (sweep_rad_ - sectors_.front()->sweep_rad >= 2 * kPi ||
               (sweep_rad_ == 0 && sectors_.front()->time_s < sectors_.back()->time_s - kFrame_s)) {
            sweep_rad_ -= sectors_.front()->sweep_rad;
            old_.push_back(std::move(sectors_.front()));
            sectors_.pop_front();
        }
        // Freed here only, because the other thread would lock the allocator's memory of this one.
        while (!old_.empty() && old_.front().use_count() == 1) old_.pop_front();
        // The other thread has a lower priority, so labelling must not wait for it.
        const std::unique_lock lock(shared_mutex_, std::try_to_lock);
        if (!lock) return;
        shared_.sectors = sectors_;
        const double now_s = live::steadyNow_s();
        if (now_s - shared_.time_s < kFrame_s) return;
        shared_.time_s = now_s;
        shared_.directions =
            settings_.directions_sent ? settings_.directions_sent() : distances_->at(now_s);
        if (settings_.motion) shared_.attitude = settings_.motion().attitude;
    }

    void show(const live::LiveReport& report, const live::LiveStatus& status,
              const std::string& autopilot) {
        if (clients_ == 0) return;
        const bool is_near = status.nearest_m > 0;  // not NaN
        const auto latency = [](double time_s) {
            return time_s > 0 ? base::fixedText(1e3 * time_s, 2) + " ms" : "-";
        };
        const std::unique_lock lock(shared_mutex_, std::try_to_lock);
        if (!lock) return;
        shared_.values = {
            {"nearest obstacle",
             is_near ? base::fixedText(static_cast<double>(status.nearest_m), 1) + " m" : "none"},
            {"rate", base::fixedText(status.turns_per_s, 1) + " Hz"},
            {"latency p50", latency(status.p50_s)},
            {"latency p99", latency(status.p99_s)},
            {"packets lost", std::to_string(report.lost)},
            {"packets dropped", std::to_string(report.dropped)},
            {"autopilot", autopilot.empty() ? "not connected" : autopilot},
            {"sensor", status.is_silent ? "silent" : "ok"}};
    }

 private:
    std::string page() const {
        std::ostringstream text;
        base::writeViewPage(text,
                            {{"format", "hagen-view-1"},
                             {"heading", settings_.heading},
                             {"live", true},
                             {"zone_m", zone_m_}},
                            {});
        return text.str();
    }

    /// Server-sent events: the newest frame, whenever the client has received the one before.
    void stream(httplib::Response& response) {
        ++clients_;
        response.set_header("Cache-Control", "no-store");
        response.set_chunked_content_provider(
            "text/event-stream",
            [this, sent = std::size_t{0}](std::size_t, httplib::DataSink& sink) mutable {
                std::unique_lock lock(frame_mutex_);
                next_.wait_for(lock, 1s, [&] { return is_at_end_ || number_ > sent; });
                if (is_at_end_) return false;
                const bool is_new = number_ > sent;
                sent = number_;
                const auto frame = frame_;
                lock.unlock();
                if (!is_new) return sink.write(": no frame\n\n", 12);  // notices closed connections
                return sink.write(frame->data(), frame->size());
            },
            [this](bool) { --clients_; });
    }

    void makeFrames() {
        for (auto next = std::chrono::steady_clock::now(); !is_at_end_; next += kPeriod) {
            std::this_thread::sleep_until(next);
            if (clients_ == 0) continue;
            try {
                auto text = std::make_shared<const std::string>("data: " + frameText() + "\n\n");
                const std::lock_guard lock(frame_mutex_);
                frame_ = std::move(text);
                ++number_;
                next_.notify_all();
            } catch (const std::bad_alloc&) {  // skips this frame
            }
        }
    }

    std::string frameText() {
        std::unique_lock lock(shared_mutex_);
        const Shared shared = shared_;
        lock.unlock();
        const double now_s = live::steadyNow_s();
        // A silent sensor: all directions are unknown, and old returns are not shown.
        const bool is_stale = now_s - shared.time_s > settings_.directions.stale_s;
        base::ViewReturns all;
        for (const auto& sector : is_stale ? Sectors() : shared.sectors) {
            for (std::size_t i = 0; i < sector->label.size(); ++i) {
                if (sector->label[i] == Label::Unclassified) continue;  // without a range
                all.add(sector->x_m[i], sector->y_m[i], sector->z_m[i],
                        static_cast<std::uint8_t>(sector->label[i]));
                if (!sector->intensity.empty()) all.intensity.push_back(sector->intensity[i]);
            }
        }
        base::ViewArrays arrays;
        addReturns(all, arrays);
        const Eigen::Matrix3f mounted =
            settings_.directions.body_from_sensor.linear().cast<float>();
        const Eigen::AngleAxisf yaw(std::atan2(mounted(1, 0), mounted(0, 0)),
                                    Eigen::Vector3f::UnitZ());
        const Eigen::Matrix3f turned =
            shared.attitude ? Eigen::Matrix3f(yaw * levelFromSensor(*shared.attitude)) : mounted;
        Json pose = Json::array();
        for (int row = 0; row < 3; ++row) {
            for (int column = 0; column < 3; ++column) {
                pose.push_back(static_cast<double>(turned(row, column)));
            }
            pose.push_back(0);
        }
        Json frame = {{"values", shared.values},
                      {"pose", pose},
                      {"directions", jsonOf(is_stale ? live::Directions{} : shared.directions,
                                            settings_.directions.begin_rad, now_s)}};
        frame.update(arrays.json(kFastDeflate));
        return base::dumpJson(frame);
    }

    const Settings settings_;
    httplib::Server server_;
    std::atomic<int> clients_ = 0;
    std::atomic<bool> is_at_end_ = false, has_served_ = false;
    float zone_m_ = 0;

    using Sectors = std::deque<std::shared_ptr<const Sector>>;
    // Of the labelling thread.
    Sectors sectors_;       ///< of the latest turn
    Sectors old_;           ///< before, still in use
    double sweep_rad_ = 0;  ///< of these sectors
    std::optional<live::SectorDistances> distances_;

    struct Shared {
        Sectors sectors;
        live::Directions directions{};
        double time_s = 0;  ///< of the directions
        std::optional<Attitude> attitude;
        Json values = Json::object();
    };
    std::mutex shared_mutex_;
    Shared shared_;

    std::mutex frame_mutex_;  ///< guards the next two
    std::shared_ptr<const std::string> frame_;
    std::size_t number_ = 0;
    std::condition_variable next_;
    std::thread server_thread_, frame_thread_;
};

LiveView::LiveView(Settings settings) : work_(std::make_unique<Work>(std::move(settings))) {}
LiveView::~LiveView() = default;
void LiveView::begin(const SensorModel& sensor, const Options& options) {
    work_->begin(sensor, options);
}
void LiveView::take(const live::LabelledSector& sector) { work_->take(sector); }
void LiveView::show(const live::LiveReport& report, const live::LiveStatus& status,
                    const std::string& autopilot) {
    work_->show(report, status, autopilot);
}

}  // namespace hagen
