#include "sensors/velodyne/AzimuthView.h"

#include <algorithm>

namespace hagen::sensors {
namespace {

constexpr int kBin = 10, kMaxStart = 1000;  // a packet covers up to 9.6 degrees at 20 Hz
constexpr int kMinWidth = 800;              // a lost packet of a VLP-16 leaves 4.8 degrees at 10 Hz
constexpr int kMaxBlockStep = 300;          // larger steps skip blocks
constexpr int kMaxBeside = 2000;            // a skip may include lost packets beside the sector

int clockwise(int from, int to) { return (to - from + kReadingsOfTurn) % kReadingsOfTurn; }

}  // namespace

double SilentSector::shareOf(int from_azimuth, int to_azimuth) const {
    if (from_azimuth < 0 || to_azimuth < 0) return 0;
    const int turned = clockwise(from_azimuth, to_azimuth);
    const int after_start = clockwise(from, from_azimuth);  // of the sector
    const int silent = after_start < width
                           ? std::min(width - after_start, turned)
                           : std::clamp(turned - clockwise(from_azimuth, from), 0, width);
    return silent > 0 ? static_cast<double>(silent) / turned : 0;
}

void AzimuthView::add(const VelodynePacket& packet) {
    bool is_in_packet = false;
    for (int block = 0; block < kVelodyneBlocks; ++block) {
        const int azimuth = packet.azimuthOf(block);
        if (azimuth < 0) continue;
        add(azimuth, is_in_packet);
        is_in_packet = true;
    }
}

void AzimuthView::add(int azimuth, bool is_in_packet) {
    if (first_ < 0) first_ = azimuth;
    const int step = last_ < 0 ? 0 : clockwise(last_, azimuth);
    const int first = step <= kMaxBlockStep && last_ >= 0 ? last_ : azimuth;
    const auto see = [this](int at) { seen_.set(static_cast<std::size_t>(at / kBin)); };
    for (int at = 0; at < clockwise(first, azimuth); at += kBin) {
        see((first + at) % kReadingsOfTurn);
    }
    see(azimuth);
    if (step >= kMinWidth && skips_used_ < skips_.size()) {
        skips_[skips_used_++] = {last_, step, is_in_packet};
    }
    last_ = azimuth;
}

std::optional<SilentSector> AzimuthView::silence() const {
    SilentSector gap;
    int gaps = 0;
    const int bins = static_cast<int>(kBins);
    int first = 0;  // a seen bin, so that no gap contains the start
    while (first < bins && !seen_[static_cast<std::size_t>(first)]) ++first;
    int width = 0;
    for (int i = first + 1; i <= first + bins; ++i) {
        if (!seen_[static_cast<std::size_t>(i % bins)]) {
            ++width;
            continue;
        }
        if (width * kBin >= kMinWidth) {
            gap = {(i - width) % bins * kBin, width * kBin, 0};
            ++gaps;
        }
        width = 0;
    }
    if (first == bins || gaps > 1) return std::nullopt;
    if (gaps == 0) return gap;
    const bool starts_at_sector = clockwise(gap.from + gap.width, first_) < kMaxBlockStep;
    const bool is_cut = first_ < kMaxStart && !starts_at_sector;
    gap.cut = is_cut ? 0 : (gap.from + gap.width / 2) % kReadingsOfTurn;
    const auto skipsGap = [&](const Skip& skip) {
        return clockwise(skip.from, gap.from) + gap.width <= skip.width &&
               skip.width <= gap.width + kMaxBeside;
    };
    const auto inPacket = [&](const Skip& skip) { return skip.is_in_packet && skipsGap(skip); };
    const auto end = skips_.begin() + static_cast<std::ptrdiff_t>(skips_used_);
    const bool is_known = std::count_if(skips_.begin(), end, skipsGap) >= 2 ||
                          std::any_of(skips_.begin(), end, inPacket);
    return is_known ? std::optional(gap) : std::nullopt;
}

}  // namespace hagen::sensors
