#include <hagen/trials/Campaign.h>
#include <hagen/trials/DealRuns.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <fstream>
#include <iostream>
#include <memory>
#include <thread>

#include "WorkerProcess.h"

namespace hagen::trials {
namespace {

namespace fs = std::filesystem;

/// Counts the lines of a file that another process appends to.
class LineCounter {
 public:
    explicit LineCounter(fs::path file) : file_(std::move(file)) {}

    std::size_t count() {
        std::ifstream in(file_, std::ios::binary);
        in.seekg(read_);
        for (char c = 0; in.get(c); read_ += 1) lines_ += c == '\n' ? 1 : 0;
        return lines_;
    }

 private:
    fs::path file_;
    std::streamoff read_ = 0;
    std::size_t lines_ = 0;
};

/// Flies share after share, each in a process of its own, all into one journal.
class Job {
 public:
    Job(WorkerCommand command, const CampaignFolder& folder, fs::path journal)
        : command_(std::move(command)), journal_(std::move(journal)), lines_(journal_) {
        for (const std::string& argument :
             {std::string("--parent"), std::to_string(getpid()), std::string("--profile"),
              folder.profileFile().string(), std::string("--journal"), journal_.string()}) {
            command_.arguments.push_back(argument);
        }
    }

    bool isIdle() const { return worker_ == nullptr; }
    /// Whether its process ended before it flew all of its share, without failing.
    bool wasStopped() const { return was_stopped_; }
    std::size_t done() { return lines_.count(); }

    void start(const RunShare& share) {
        share_ = share;
        done_before_ = done();
        std::vector<std::string> arguments = command_.arguments;
        arguments.insert(arguments.end(), share.begin(), share.end());
        worker_ = std::make_unique<WorkerProcess>(command_.program, arguments);
    }

    void stop() const {
        if (worker_) worker_->stop();
    }

    /// Makes the job idle if its process has ended. Returns why it failed, if it did.
    std::string look() {
        if (!worker_ || !worker_->hasEnded()) return "";
        const std::unique_ptr<WorkerProcess> ended = std::move(worker_);
        const std::string failure = ended->failure(), errors = ended->errors();
        const std::size_t flown = done() - done_before_;
        if (failure.empty()) {
            if (!errors.empty()) std::cerr << errors << std::endl;
            was_stopped_ = flown < share_.size();
            return "";
        }
        if (!ended->wasKilled() && !errors.empty()) return errors;
        return "a worker " + failure + " at " + share_[std::min(flown, share_.size() - 1)] +
               (errors.empty() ? "" : ": " + errors);
    }

 private:
    WorkerCommand command_;
    fs::path journal_;
    LineCounter lines_;
    RunShare share_;
    std::size_t done_before_ = 0;  ///< lines of the journal when the process was started
    std::unique_ptr<WorkerProcess> worker_;
    bool was_stopped_ = false;
};

std::size_t doneOf(std::vector<Job>& jobs) {
    std::size_t done = 0;
    for (Job& job : jobs) done += job.done();
    return done;
}

/// Gives shares to idle jobs until all are flown, or it is told to stop. Returns why a process
/// failed, if one did.
std::string flyAll(const std::vector<RunShare>& shares, std::size_t all,
                   const CampaignOptions& options, std::vector<Job>& jobs) {
    std::string failure;
    bool stops = false;
    for (std::size_t next = 0;;) {
        bool is_told = options.keep_going && !options.keep_going();
        for (Job& job : jobs) {
            const std::string failed = job.look();
            if (failure.empty()) failure = failed;
            is_told = is_told || !failed.empty() || job.wasStopped();
        }
        if (is_told && !stops) {
            for (const Job& job : jobs) job.stop();
            stops = true;
        }
        bool is_flying = false;
        for (Job& job : jobs) {
            if (job.isIdle() && !stops && next < shares.size()) job.start(shares[next++]);
            is_flying = is_flying || !job.isIdle();
        }
        if (!is_flying) return failure;
        if (options.progress) options.progress(doneOf(jobs), all);
        std::this_thread::sleep_for(std::chrono::milliseconds(50));
    }
}

}  // namespace

std::size_t flyCampaign(const std::vector<CourseFlights>& flights, const CampaignOptions& options,
                        CampaignFolder& folder) {
    const auto wanted = static_cast<std::size_t>(std::max(1, options.jobs));
    const std::vector<RunShare> shares =
        dealRuns(flights, wanted, [&](const Run& run) { return folder.has(run); });
    std::size_t all = 0;
    for (const RunShare& share : shares) all += share.size();
    std::vector<Job> jobs;
    while (jobs.size() < std::min(shares.size(), wanted)) {
        jobs.emplace_back(options.worker, folder, folder.newJournal());
    }
    const std::string failure = flyAll(shares, all, options, jobs);
    const std::size_t done = doneOf(jobs);
    const std::string kept =
        " are kept in " + (folder.path() / "journal").string() + "; the same command resumes there";
    if (!failure.empty()) {
        throw std::runtime_error(failure + "; " + std::to_string(done) + " finished runs" + kept);
    }
    if (done < all) {
        throw CampaignStopped("interrupted; " + std::to_string(done) + " of " +
                              std::to_string(all) + " runs" + kept);
    }
    folder.readJournals();
    folder.finish();
    return all;
}

}  // namespace hagen::trials
