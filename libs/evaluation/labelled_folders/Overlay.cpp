#include "evaluation/labelled_folders/Overlay.h"
#include "base/TextStream.h"

#include <algorithm>
#include <array>
#include <locale>
#include <stdexcept>
#include <string>
#include "convert/pictures/Gnuplot.h"

namespace hagen::evaluation {
namespace {

namespace fs = std::filesystem;

/// Outcome of a pixel, in drawing order: errors are on top.
enum Outcome { LeftOut, RouFound, RoiFound, FalseAlarm, RoiMissed, kOutcomes };
struct Style {
    const char *name, *colour;
};
// Colour-blind safe palette (Okabe and Ito).
constexpr std::array<Style, kOutcomes> kStyles{{{"not scored or not labelled", "#DDDDDD"},
                                                {"ROU found", "#A9BCCB"},
                                                {"RoI found", "#0072B2"},
                                                {"ROU labelled RoI", "#E69F00"},
                                                {"RoI missed", "#D00000"}}};

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

void draw(const fs::path& picture, const std::string& title, const MethodOutput& view,
          const PinholeCamera& camera, float max_range_m) {
    std::array<std::size_t, kOutcomes> counts{};
    std::array<base::TextStream, kOutcomes> points;
    for (const CameraPixel& pixel : view.pixels) {
        const bool is_scored = view.truth.input.scan.range_m[pixel.index] <= max_range_m;
        const Outcome outcome =
            is_scored ? outcomeOf(view.truth.truth[pixel.index], view.found[pixel.index]) : LeftOut;
        points[outcome] << pixel.u << " " << pixel.v << "\n";
        ++counts[outcome];
    }
    base::TextStream script;
    for (int o = 0; o < kOutcomes; ++o) {  // gnuplot rejects an empty block
        script << "$outcome" << o << " << EOD\nNaN NaN\n" << points[o].str() << "EOD\n";
    }
    constexpr int kMargin_px = 40;  // for title and legend
    const int scale = camera.width_px < 1000 ? 2 : 1;
    const int width_px = scale * camera.width_px, height_px = scale * camera.height_px;
    script << "set terminal pngcairo size " << width_px << "," << height_px + 2 * kMargin_px
           << " font 'sans,13' background '#FFFFFF'\nset output "
           << convert::gnuplotString(picture.filename().string())
           << "\nset lmargin at screen 0\nset rmargin at screen 1\nset tmargin at screen "
           << 1.0 - static_cast<double>(kMargin_px) / (height_px + 2 * kMargin_px)
           << "\nset bmargin at screen "
           << static_cast<double>(kMargin_px) / (height_px + 2 * kMargin_px)
           << "\nset xrange [-0.5:" << camera.width_px - 0.5 << "]\nset yrange ["
           << camera.height_px - 0.5 << ":-0.5]\nunset tics\nset border 15 lc rgb '#BBBBBB'\n"
           << "set label " << convert::gnuplotString(title)
           << " at screen 0.01, graph 1.0 offset 0,1 left "
           << "noenhanced\nset key at screen 0.5, screen 0.008 center bottom horizontal "
              "maxrows 1 reverse Left samplen 0.5 font 'sans,11'\nplot ";
    for (int o = 0; o < kOutcomes; ++o) {
        script << (o == 0 ? "" : ", ") << "$outcome" << o << " with points pt 7 ps " << 0.35 * scale
               << " lc rgb '" << kStyles[o].colour
               << "' notitle, NaN with points pt 7 ps 1.5 lc rgb '" << kStyles[o].colour
               << "' title '" << kStyles[o].name << " (" << counts[o] << ")'";
    }
    script << "\nunset output\n";
    convert::runGnuplot(script.str(), picture.parent_path(), {picture.filename().string()});
}

}  // namespace

const base::OutputKind kOverlays{
    "a folder of pictures", [](const std::filesystem::path& within) {
        const std::string name = within.filename().string(), end = "_overlay.png";
        return name.size() >= end.size() &&
               name.compare(name.size() - end.size(), end.size(), end) == 0;
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
    draw(picture, source + ", scan " + scan + ", " + view.method_name, view, *options.camera,
         options.range.max_range_m);
}

}  // namespace hagen::evaluation
