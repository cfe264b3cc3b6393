#include <hagen/base/Folder.h>
#include <hagen/base/NumberText.h>
#include <hagen/base/OutputPath.h>
#include <hagen/logs/RecordedObject.h>
#include <hagen/recording/TurnRecorder.h>

#include <cstdio>
#include <exception>
#include <new>
#include <stdexcept>
#include <system_error>
#include <utility>

namespace hagen::recording {
namespace {

constexpr std::size_t kMostWaiting = 50;  // turns: seconds, about 10 MB

}  // namespace

TurnRecorder::TurnRecorder(Options options, const Settings& settings)
    : options_(std::move(options)) {
    segmenter_.setMinLoggingLevel(mrpt::system::LVL_ERROR);
    segmenter_.initialize(settings);
    checkNumbers();
    openNext();
    thread_ = std::thread([this] { work(); });
}

TurnRecorder::~TurnRecorder() {
    if (thread_.joinable()) finish();
}

std::filesystem::path TurnRecorder::nextName() {
    if (options_.rotate_bytes == 0) return options_.file;
    char number[16];
    std::snprintf(number, sizeof number, ".%04zu", ++number_);
    std::filesystem::path name = options_.file;
    return name.replace_filename(options_.file.stem().string() + number +
                                 options_.file.extension().string());
}

/// Of NAME.0001.EXTENSION.
std::optional<std::size_t> TurnRecorder::numberOf(const std::filesystem::path& file) const {
    const std::string stem = options_.file.stem().string() + ".";
    const std::string extension = options_.file.extension().string();
    const std::string name = file.filename().string();
    if (name.size() <= stem.size() + extension.size() || name.compare(0, stem.size(), stem) != 0 ||
        file.extension() != extension) {
        return std::nullopt;
    }
    return base::numberFrom<std::size_t>(
        name.substr(stem.size(), name.size() - stem.size() - extension.size()));
}

/// Whether a file, which need not exist, would be a part of this recording.
bool TurnRecorder::isNumbered(const std::filesystem::path& file) const {
    const auto folderOf = [](const std::filesystem::path& path) {
        return std::filesystem::absolute(path).lexically_normal().parent_path();
    };
    return options_.rotate_bytes > 0 && !file.empty() && numberOf(file) &&
           folderOf(file) == folderOf(options_.file);
}

/// The numbered files that are there already, by number.
std::map<std::size_t, std::filesystem::path> TurnRecorder::numbered() const {
    std::map<std::size_t, std::filesystem::path> files;
    if (options_.rotate_bytes == 0) return files;
    const std::filesystem::path folder = options_.file.parent_path();
    std::error_code none;
    for (const auto& file : base::entriesOf(folder.empty() ? "." : folder, none)) {
        if (const auto number = numberOf(file)) files.emplace(*number, file);
    }
    return files;
}

/// Before anything is recorded: a number that is taken would end the recording in flight.
void TurnRecorder::checkNumbers() const {
    const auto files = numbered();
    for (const std::filesystem::path& other : options_.others) {
        for (const auto& [number, file] : files) {
            std::error_code none;
            if (std::filesystem::equivalent(file, other, none)) {
                throw std::runtime_error(file.string() +
                                         ": is another file of the session, and would be a part of "
                                         "this recording; choose another name");
            }
        }
        if (isNumbered(other)) {
            throw std::runtime_error(other.string() +
                                     ": has the name of a part of this recording; choose another "
                                     "name");
        }
    }
    for (const auto& [number, file] : files) {
        if (std::filesystem::is_regular_file(std::filesystem::symlink_status(file))) continue;
        throw std::runtime_error(file.string() +
                                 ": is no file, so no part of this recording can have its name; "
                                 "choose another one");
    }
    if (options_.overwrite || files.empty()) return;
    throw std::runtime_error(files.begin()->second.string() +
                             ": exists; it would be a part of this recording (--overwrite replaces "
                             "such files)");
}

void TurnRecorder::openNext() {
    writing_ = nextName();
    base::checkApart({writing_}, options_.others, "another file of the session");
    writer_.emplace(writing_, options_.overwrite);
}

void TurnRecorder::add(const mrpt::obs::CObservation::Ptr& turn) {
    std::unique_lock lock(mutex_);
    if (options_.waits) {
        changed_.wait(lock, [&] { return waiting_.size() < kMostWaiting || !failure_.empty(); });
    }
    if (!failure_.empty() || waiting_.size() >= kMostWaiting) {
        ++left_out_;
        return;
    }
    waiting_.push_back(turn);
    lock.unlock();
    changed_.notify_all();
}

std::string TurnRecorder::failure() const {
    const std::lock_guard lock(mutex_);
    return failure_;
}

void TurnRecorder::work() {
    while (true) {
        std::unique_lock lock(mutex_);
        changed_.wait(lock, [&] { return !waiting_.empty() || is_at_end_; });
        if (waiting_.empty()) return;
        const mrpt::obs::CObservation::Ptr turn = std::move(waiting_.front());
        waiting_.pop_front();
        lock.unlock();
        changed_.notify_all();
        try {
            write(turn);
        } catch (const std::bad_alloc&) {
            return fail(nullptr);
        } catch (const std::exception& e) {
            return fail(e.what());
        }
    }
}

/// Without a reason, or memory for it: out of memory.
void TurnRecorder::fail(const char* why) noexcept {
    const std::lock_guard failing(mutex_);
    failure_ = "out of memory";  // as short as needs none
    try {
        if (why != nullptr) {
            failure_ = base::withOutputNames(why);
        } else {
            failure_ = writing_.string() + ": out of memory";
        }
    } catch (const std::bad_alloc&) {  // as it is
    }
    left_out_ += (is_in_hand_ ? 1 : 0) + waiting_.size();
    waiting_.clear();
    changed_.notify_all();
}

void TurnRecorder::write(const mrpt::obs::CObservation::Ptr& turn) {
    is_in_hand_ = true;
    if (!writer_) openNext();
    entries_.clear();
    logs::serialise(*logs::objectOf(turn, observations::CloudClass::Simple), entries_);
    try {
        segmenter_.process(*turn, output_);
        logs::serialise(*output_.roi, entries_);
        logs::serialise(*output_.non_roi, entries_);
    } catch (const std::bad_alloc&) {
        throw;
    } catch (const std::exception&) {  // as rawlog-segment: kept, not segmented
        ++recorded_.unreadable;
    }
    writer_->gather(entries_, member_);
    is_in_hand_ = false;
    ++gathered_;
    if (!member_.empty()) {
        logs::packGzipMember(member_, packed_);
        written_bytes_ += packed_.size();
        writer_->writeMember(packed_);
        recorded_.turns += std::exchange(gathered_, 0);
    }
    has_turns_ = true;
    if (options_.rotate_bytes > 0 && written_bytes_ >= options_.rotate_bytes) endFile();
}

void TurnRecorder::endFile() {
    writer_->commit();
    recorded_.turns += std::exchange(gathered_, 0);
    writer_.reset();
    recorded_.files.push_back(writing_);
    written_bytes_ = 0;
    has_turns_ = false;
}

live::Recorded TurnRecorder::finish() {
    {
        const std::lock_guard lock(mutex_);
        is_at_end_ = true;
    }
    changed_.notify_all();
    if (thread_.joinable()) thread_.join();
    if (failure_.empty()) {
        try {
            // Nothing was received, or the last turn ended a file.
            if (writer_ && !has_turns_) writer_.reset();
            if (writer_) endFile();
        } catch (const std::exception& e) {
            fail(e.what());
        }
    }
    recorded_.failure = failure_;
    for (const auto& [number, file] : numbered()) {
        if (number > recorded_.files.size()) recorded_.older_files.push_back(file);
    }
    if (writer_) {  // it has failed
        try {
            recorded_.failure += "; what was written is in " + writer_->keepPartial().string();
        } catch (const std::exception&) {  // nothing was written
        }
        // Perhaps it failed only when it got its name.
        (writer_->isWhole() ? recorded_.turns : left_out_) += std::exchange(gathered_, 0);
    }
    recorded_.left_out = left_out_;
    writer_.reset();
    return recorded_;
}

}  // namespace hagen::recording
