#include "convert/pictures/AirframePicture.h"
#include "convert/pictures/Drawing.h"

namespace hagen::convert {

void drawAirframe(const Image<float>& bin_range_m, const std::string& title,
                  const std::filesystem::path& file) {
    Drawing drawing({{"kind", "airframe"}, {"file", file.string()}, {"title", title}});
    drawing.add("bin_range_m", bin_range_m);
    drawing.draw();
}

}  // namespace hagen::convert
