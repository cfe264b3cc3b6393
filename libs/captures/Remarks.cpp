#include "Remarks.h"

namespace hagen::captures {

std::string counted(std::size_t number, const std::string& one) {
    return std::to_string(number) + " " + one + (number == 1 ? "" : "s");
}

void addCount(std::size_t number, const std::string& one, const std::string& more,
              std::string& text) {
    if (number == 0) return;
    text += (text.empty() ? "" : ", ") + counted(number, one) + " " + more;
}

std::string textOfLosses(const FrameCounts& counts) {
    std::string text;
    addCount(counts.other_traffic, "frame", "of other traffic", text);
    addCount(counts.cut_frames, "frame", "cut short by the capture", text);
    addCount(counts.fragments_lost, "IP fragment", "of incomplete datagrams", text);
    return text;
}

}  // namespace hagen::captures
