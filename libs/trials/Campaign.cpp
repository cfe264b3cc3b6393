#include <hagen/trials/Campaign.h>
#include <hagen/trials/Journal.h>
#include <hagen/trials/Trial.h>
#include <signal.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <chrono>
#include <cstdio>
#include <cstring>
#include <new>
#include <thread>

namespace hagen {
namespace {

/// What the processes of a campaign tell one another, in memory that they share.
struct Shared {
    struct Worker {
        char doing[192];   ///< the run in hand
        char failed[512];  ///< why it gave up
    };
    std::atomic<std::size_t> next_course{0}, done{0};
    std::atomic<bool> stops{false};
    Worker workers[1];  ///< as many as there are
};
static_assert(std::atomic<std::size_t>::is_always_lock_free);

class SharedMemory {
 public:
    explicit SharedMemory(std::size_t workers)
        : size_(sizeof(Shared) + workers * sizeof(Shared::Worker)),
          memory_(mmap(nullptr, size_, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0)) {
        if (memory_ == MAP_FAILED) throw std::bad_alloc();
        new (memory_) Shared;
    }
    ~SharedMemory() { munmap(memory_, size_); }
    SharedMemory(const SharedMemory&) = delete;
    SharedMemory& operator=(const SharedMemory&) = delete;
    Shared& operator*() { return *static_cast<Shared*>(memory_); }

 private:
    std::size_t size_;
    void* memory_;
};

void copyText(const std::string& text, char* to, std::size_t size) {
    std::snprintf(to, size, "%s", text.c_str());
}

struct Stopped {};

/// One process: takes course after course until none is left.
class Worker {
 public:
    Worker(const std::vector<CourseFlights>& flights, const LatencyProfile& profile,
           const CampaignOptions& options, const CampaignFolder& folder, Shared& shared, int number)
        : flights_(flights),
          profile_(profile),
          options_(options),
          folder_(folder),
          shared_(shared),
          self_(shared.workers[number]) {}

    void flyAll(const std::filesystem::path& journal_file) {
        Journal journal(journal_file);
        for (;;) {
            const std::size_t course = shared_.next_course++;
            if (course >= flights_.size()) return;
            stopIfTold();
            flyCourse(flights_[course], journal);
        }
    }

 private:
    void flyCourse(const CourseFlights& flights, Journal& journal) {
        tell("making " + flights.scenario + " seed " + std::to_string(flights.seed));
        const Course course = makeCourse(flights.scenario, flights.seed);
        Run run;
        run.scenario = flights.scenario;
        run.seed = flights.seed;
        run.oracle_path_m = course.oracle_path_m;
        run.settings_hash = folder_.settingsHash();
        run.version = HAGEN_VERSION;
        TrialListener listener;
        listener.moved = [this](double, const VehicleState&) { stopIfTold(); };
        for (const TrialSetup& setup : flights.setups) {
            run.setup = setup;
            tell(keyOf(run));
            TrialMeasurement measurement;
            run.result = runTrial(course, setup, profile_, &measurement, listener);
            journal.append(run, measurement);
            ++shared_.done;
        }
    }
    void tell(const std::string& what) { copyText(what, self_.doing, sizeof self_.doing); }
    void stopIfTold() {
        if (shared_.stops || (options_.keep_going && !options_.keep_going())) throw Stopped();
    }

    const std::vector<CourseFlights>& flights_;
    const LatencyProfile& profile_;
    const CampaignOptions& options_;
    const CampaignFolder& folder_;
    Shared& shared_;
    Shared::Worker& self_;
};

/// What is not flown yet; courses without a flight are left out.
std::vector<CourseFlights> remaining(std::vector<CourseFlights> flights,
                                     const CampaignFolder& folder) {
    for (CourseFlights& course : flights) {
        Run run;
        run.scenario = course.scenario;
        run.seed = course.seed;
        const auto is_flown = [&](const TrialSetup& setup) {
            run.setup = setup;
            return folder.has(run);
        };
        course.setups.erase(std::remove_if(course.setups.begin(), course.setups.end(), is_flown),
                            course.setups.end());
    }
    flights.erase(std::remove_if(flights.begin(), flights.end(),
                                 [](const CourseFlights& course) { return course.setups.empty(); }),
                  flights.end());
    return flights;
}

std::string causeOf(int status, const Shared::Worker& worker) {
    if (worker.failed[0] != '\0') return worker.failed;
    const std::string run = worker.doing;
    if (WIFSIGNALED(status)) {
        return "a worker was killed by signal " + std::to_string(WTERMSIG(status)) + " (" +
               strsignal(WTERMSIG(status)) + ") at " + run;
    }
    return "a worker ended at " + run;
}

/// The processes of a campaign. Those that still run when it goes out of scope are stopped.
class Workers {
 public:
    explicit Workers(Shared& shared) : shared_(shared) {}
    ~Workers() {
        shared_.stops = true;
        while (!pids_.empty()) waitForOne(0);
    }
    Workers(const Workers&) = delete;
    Workers& operator=(const Workers&) = delete;

    template <class Work>
    void start(Work work) {
        const int number = static_cast<int>(pids_.size());
        const pid_t parent = getpid(), pid = fork();
        if (pid < 0) throw std::runtime_error(std::string("fork: ") + std::strerror(errno));
        if (pid == 0) {
            prctl(PR_SET_PDEATHSIG, SIGKILL);
            if (getppid() != parent) _exit(1);
            _exit(work(number));
        }
        pids_.push_back(pid);
        numbers_.push_back(number);
    }

    bool areGone() const { return pids_.empty(); }

    /// Takes leave of one that has ended; all others are told to stop where it failed.
    void waitForOne(int options) {
        for (std::size_t i = 0; i < pids_.size(); ++i) {
            int status = 0;
            const pid_t ended = waitpid(pids_[i], &status, options);
            if (ended == 0 || (ended < 0 && errno == EINTR)) continue;
            if (!WIFEXITED(status) || WEXITSTATUS(status) != 0) {
                shared_.stops = true;
                if (failure.empty()) failure = causeOf(status, shared_.workers[numbers_[i]]);
            }
            pids_.erase(pids_.begin() + static_cast<std::ptrdiff_t>(i));
            numbers_.erase(numbers_.begin() + static_cast<std::ptrdiff_t>(i));
            return;
        }
    }

    std::string failure;

 private:
    Shared& shared_;
    std::vector<pid_t> pids_;
    std::vector<int> numbers_;
};

void watch(Workers& workers, std::size_t all, const CampaignOptions& options, Shared& shared) {
    while (!workers.areGone()) {
        if (options.keep_going && !options.keep_going()) shared.stops = true;
        if (options.progress) options.progress(shared.done, all);
        std::this_thread::sleep_for(std::chrono::milliseconds(50));
        workers.waitForOne(WNOHANG);
    }
}

}  // namespace

std::size_t flyCampaign(const std::vector<CourseFlights>& flights, const LatencyProfile& profile,
                        const CampaignOptions& options, CampaignFolder& folder) {
    const std::vector<CourseFlights> left = remaining(flights, folder);
    std::size_t all = 0;
    for (const CourseFlights& course : left) all += course.setups.size();
    const std::size_t jobs =
        std::min(left.size(), static_cast<std::size_t>(std::max(1, options.jobs)));
    SharedMemory memory(jobs);
    Shared& shared = *memory;
    {
        Workers workers(shared);
        for (std::size_t job = 0; job < jobs; ++job) {
            const auto journal = folder.newJournal();
            workers.start([&](int number) {
                Shared::Worker& self = shared.workers[number];
                try {
                    Worker(left, profile, options, folder, shared, number).flyAll(journal);
                } catch (const Stopped&) {
                } catch (const std::exception& e) {
                    copyText(e.what(), self.failed, sizeof self.failed);
                    return 1;
                }
                return 0;
            });
        }
        watch(workers, all, options, shared);
        if (!workers.failure.empty()) {
            throw std::runtime_error(workers.failure + "; " + std::to_string(shared.done) +
                                     " finished runs are kept in " +
                                     (folder.path() / "journal").string() +
                                     ", and the same command goes on from there");
        }
    }
    if (shared.done < all) {
        throw CampaignStopped("interrupted; " + std::to_string(shared.done) + " of " +
                              std::to_string(all) + " runs are kept in " +
                              (folder.path() / "journal").string() +
                              ", and the same command goes on from there");
    }
    folder.readJournals();
    folder.finish();
    return all;
}

}  // namespace hagen
