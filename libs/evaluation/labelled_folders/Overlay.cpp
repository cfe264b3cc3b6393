#include "evaluation/labelled_folders/Overlay.h"

#include <algorithm>
#include <stdexcept>
#include <string>
#include "base/Text.h"
#include "convert/pictures/Drawing.h"

namespace hagen::evaluation {
namespace {

namespace fs = std::filesystem;

/// Outcome of a pixel, as in draw.py.
enum Outcome : std::uint8_t { LeftOut, RouFound, RoiFound, FalseAlarm, RoiMissed };

Outcome outcomeOf(Label truth, Label found) {
    if (truth == Label::Unclassified) return LeftOut;
    if (found == Label::Unclassified && truth == Label::Rou) return LeftOut;
    if (truth == Label::Roi) return found == Label::Roi ? RoiFound : RoiMissed;
    return found == Label::Roi ? FalseAlarm : RouFound;
}

/// Makes a name usable for one file or folder.
std::string fileName(std::string name) {
    std::replace(name.begin(), name.end(), '/', '_');
    return name == "." || name == ".." ? "_" : name;
}

}  // namespace

const base::OutputKind kOverlays{"a folder of pictures", [](const std::filesystem::path& within) {
                                     return base::endsWith(within.filename().string(),
                                                           "_overlay.png");
                                 }};

void drawOverlay(const fs::path& folder, const std::string& source, const MethodOutput& view,
                 const EvaluationOptions& options) {
    const fs::path own = view.methods == 1 ? folder : folder / fileName(view.method_name);
    fs::create_directories(own);
    const std::string scan = fs::path(view.truth.name).stem().string();
    const fs::path picture = own / (fileName(source) + "_" + scan + "_overlay.png");
    if (fs::exists(picture)) {
        throw std::runtime_error(
            "two pictures would have the name " + fs::relative(picture, folder).string() +
            "; rename the rows or folders so that they differ by more than '/'");
    }
    const PinholeCamera& camera = *options.camera;
    convert::Drawing drawing({{"kind", "overlay"},
                              {"file", picture.string()},
                              {"title", source + ", scan " + scan + ", " + view.method_name},
                              {"width", camera.width_px},
                              {"height", camera.height_px}});
    std::vector<int> u, v;
    std::vector<Outcome> outcomes;
    for (const CameraPixel& pixel : view.pixels) {
        const bool is_scored =
            view.truth.input.scan.range_m[pixel.index] <= options.range.max_range_m;
        u.push_back(pixel.u);
        v.push_back(pixel.v);
        outcomes.push_back(is_scored
                               ? outcomeOf(view.truth.truth[pixel.index], view.found[pixel.index])
                               : LeftOut);
    }
    drawing.add("u", u);
    drawing.add("v", v);
    drawing.add("outcome", outcomes);
    drawing.draw();
}

}  // namespace hagen::evaluation
