#include <hagen/recordings/Remarks.h>

#include <algorithm>
#include <chrono>

namespace hagen::recordings {

std::string counted(std::size_t number, const std::string& one) {
    return std::to_string(number) + " " + one + (number == 1 ? "" : "s");
}

void addCount(std::size_t number, const std::string& one, const std::string& more,
              std::string& text) {
    if (number == 0) return;
    text += (text.empty() ? "" : ", ") + counted(number, one) + (more.empty() ? "" : " ") + more;
}

void OtherDatagrams::add(const sensors::Datagram& datagram) {
    constexpr std::size_t kMostKinds = 64;
    ++all_;
    const std::pair kind{datagram.to_port, datagram.size};
    if (kinds_.size() < kMostKinds || kinds_.count(kind) > 0) ++kinds_[kind];
}

void OtherDatagrams::describe(std::string& text) const {
    if (all_ == 0) return;
    const auto most =
        std::max_element(kinds_.begin(), kinds_.end(),
                         [](const auto& a, const auto& b) { return a.second < b.second; });
    addCount(all_, "other UDP datagram",
             "(most: " + std::to_string(most->second) + " of " +
                 std::to_string(most->first.second) + " bytes to port " +
                 std::to_string(most->first.first) + ")",
             text);
}

std::string textOfLosses(const sensors::FrameCounts& counts) {
    std::string text;
    addCount(counts.other_traffic, "frame", "of other traffic", text);
    addCount(counts.cut_frames, "frame", "cut short by the capture", text);
    addCount(counts.fragments_lost, "IP fragment", "of incomplete datagrams", text);
    return text;
}

std::string textOfFrames(const sensors::FrameCounts& counts, const std::string& left_out) {
    std::string text = counted(counts.frames, "frame");
    addCount(counts.tagged, "frame", "with a VLAN tag", text);
    addCount(counts.fragments, "frame", "that are IP fragments", text);
    const std::string losses = textOfLosses(counts);
    const std::string all = left_out + (left_out.empty() || losses.empty() ? "" : ", ") + losses;
    return text + "; left out: " + (all.empty() ? "none" : all);
}

mrpt::Clock::time_point timeOf(std::int64_t since_1970_ns) {
    return mrpt::Clock::fromDouble(0) + std::chrono::duration_cast<mrpt::Clock::duration>(
                                            std::chrono::nanoseconds(since_1970_ns));
}

}  // namespace hagen::recordings
