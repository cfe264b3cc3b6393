#include <hagen/live/Thinning.h>
#include <hagen/scan/RangeImage.h>

namespace hagen::live {
namespace {

constexpr float kClearlyLower_m = 0.3F;
constexpr auto kNone = static_cast<std::size_t>(-1);

}  // namespace

Thinning::Thinning(int rows, int columns, int every)
    : rows_(rows), columns_(columns), every_(every) {
    if (every == 0) return;
    const int groups = (columns + every - 1) / every;
    at_pixel_.resize(static_cast<std::size_t>(groups) * static_cast<std::size_t>(rows), kNone);
}

const std::vector<std::size_t>& Thinning::of(const Scan& packet, float up) {
    kept_.clear();
    kept_pixels_.clear();
    if (every_ == 0) return kept_;
    pixel_.resize(packet.size());
    for (std::size_t i = 0; i < packet.size(); ++i) {
        const int column = nearestColumn(packet.azimuth_rad[i], columns_);
        const auto group = static_cast<unsigned>(column) / static_cast<unsigned>(every_);
        const std::size_t pixel = group * static_cast<std::size_t>(rows_) + packet.row[i];
        pixel_[i] = pixel;
        if (column != static_cast<int>(group) * every_ || !hasValue(packet.range_m[i])) continue;
        std::size_t& at = at_pixel_[pixel];
        if (at == kNone) {
            at = kept_.size();
            kept_.push_back(i);
            kept_pixels_.push_back({pixel, 0});
        } else if (packet.range_m[i] < packet.range_m[kept_[at]]) {
            kept_[at] = i;
        }
        kept_pixels_[at].below_m = up * packet.z_m[kept_[at]] - kClearlyLower_m;
    }
    for (std::size_t i = 0; i < packet.size(); ++i) {
        const std::size_t at = at_pixel_[pixel_[i]];
        if (at == kNone || !hasValue(packet.range_m[i])) continue;  // includes masked returns
        if (!(up * packet.z_m[i] < kept_pixels_[at].below_m)) continue;
        kept_[at] = i;
        kept_pixels_[at].below_m = up * packet.z_m[i];
    }
    for (const Kept& kept : kept_pixels_) at_pixel_[kept.pixel] = kNone;
    return kept_;
}

}  // namespace hagen::live
