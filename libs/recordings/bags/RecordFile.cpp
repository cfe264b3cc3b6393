#include "recordings/bags/RecordFile.h"

#include "recordings/Remarks.h"

namespace hagen::recordings {

bool RecordFile::next(BagMessage& message) {
    while (!is_at_end_) {
        check();
        const bool is_in_chunk = in_chunk_.left() > 0;
        if (!is_in_chunk) {
            record_at_ = file_.position();
            is_chunk_ = false;
        }
        try {
            if (file_.isSkipping()) {
                file_.skipSome();
            } else if (is_in_chunk ? readInChunk(message) : readRecord(message)) {
                return true;
            }
        } catch (const BrokenRecording&) {
            throw;
        } catch (const std::runtime_error& e) {
            in_chunk_ = FieldReader(ByteView());
            if (!is_chunk_) file_.fail("a record", record_at_, e.what());
            is_damaged_ = true;
            if (!damage_.empty()) {
                ++further_;
                continue;
            }
            damage_ = file_.textOf("the chunk", record_at_, e.what()) + "; skipped " +
                      std::to_string(file_.position() - record_at_) + " bytes";
        }
    }
    return false;
}

std::string RecordFile::takeDamage() {
    if (further_ > 0) damage_ += ", and " + counted(further_, "further damaged chunk");
    further_ = 0;
    return std::exchange(damage_, "");
}

bool RecordFile::take(const char* channel_name, std::uint32_t channel, std::int64_t time_ns,
                      ByteView data, BagMessage& message) const {
    const auto topic = topic_of_.find(channel);
    if (topic == topic_of_.end()) {
        throw std::runtime_error(std::string("a message belongs to ") + channel_name + " " +
                                 std::to_string(channel) + ", which is not defined before it");
    }
    message = {topic->second, time_ns, data.data, data.size};
    return true;
}

}  // namespace hagen::recordings
