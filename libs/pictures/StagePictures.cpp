#include <hagen/pictures/Gnuplot.h>
#include <hagen/pictures/StagePictures.h>
#include <hagen/range_image/Angle.h>
#include <hagen/segmentation/SingularSpectrumAnalysis.h>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <locale>
#include <sstream>
#include <tuple>
#include <vector>

namespace hagen {
namespace {

/// Colours that the colour-blind tell apart (Okabe and Ito); an obstacle takes the one of its
/// number, the nearest the first. ROU and empty pixels are pale beside all of them.
constexpr std::array<const char*, 6> kRoiColours{"#D55E00", "#0072B2", "#009E73",
                                                 "#CC79A7", "#E69F00", "#7A1F5C"};
constexpr const char* kRou = "#A9BCCB";
constexpr const char* kEmpty = "#E9E9E9";
constexpr const char* kInk = "#333333";
/// Perceptually uniform: viridis for depths, cividis for angles.
constexpr const char* kDepthPalette =
    "defined (0 '#440154', 1 '#472D7B', 2 '#3B528B', 3 '#2C728E', 4 '#21918C', 5 '#28AE80', "
    "6 '#5EC962', 7 '#ADDC30', 8 '#FDE725')";
constexpr const char* kAnglePalette =
    "defined (0 '#00224E', 1 '#123570', 2 '#3B496C', 3 '#575D6D', 4 '#707173', 5 '#8A8678', "
    "6 '#A59C74', 7 '#C3B369', 8 '#E1CC55', 9 '#FEE838')";

constexpr int kWidth_px = 1200;
constexpr int kMostBars = 60;
constexpr int kMostComponents = 12;
constexpr double kZoomHalf_deg = 30.0;

/// A stream whose numbers read the same whatever locale the program has set.
std::ostringstream plainText() {
    std::ostringstream text;
    text.imbue(std::locale::classic());
    text.precision(5);
    return text;
}

/// A number with one decimal.
std::string oneDecimal(double value) {
    std::ostringstream text = plainText();
    text.setf(std::ios::fixed);
    text.precision(1);
    text << value;
    return text.str();
}

/// A place in a picture, in pixels from its lower left corner.
struct Box {
    double left, right, bottom, top;
};

std::size_t colourOf(std::int32_t component) {
    return static_cast<std::size_t>(std::max(component, 1) - 1) % kRoiColours.size();
}

double azimuthDeg(int column, int columns) {
    return degrees(static_cast<double>(columnAzimuth(column, columns)));
}

/// The longest run of a column's angles; empty where none is as long as the window.
struct Run {
    int first_row = 0, rows = 0;
};
Run smoothedRun(const Image<float>& angles, int column, int window_size) {
    Run longest;
    const int rows = static_cast<int>(angles.rows());
    for (int row = 0, first = 0; row <= rows; ++row) {
        if (row < rows && hasValue(angles(row, column))) continue;
        if (row - first > longest.rows) longest = {first, row - first};
        first = row + 1;
    }
    return longest.rows >= window_size ? longest : Run();
}

int columnToShow(const StageView& view) {
    const SegmentationResult& r = view.result;
    const int columns = static_cast<int>(r.labels.cols());
    const float azimuth_deg = view.azimuth_deg.value_or(0.0f);
    int chosen =
        nearestColumn(static_cast<float>(radians(std::remainder(azimuth_deg, 360.0f))), columns);
    if (view.azimuth_deg) return chosen;
    bool best_is_smoothed = false;
    float best_m = std::numeric_limits<float>::infinity();
    for (int column = 0; column < columns; ++column) {
        const bool is_smoothed =
            smoothedRun(r.range_angle_rad, column, view.options.window_size).rows > 0;
        if (best_is_smoothed && !is_smoothed) continue;
        for (int row = 0; row < r.labels.rows(); ++row) {
            if (r.labels(row, column) != Label::Roi) continue;
            const float depth_m = r.repaired_m(row, column);
            if (is_smoothed == best_is_smoothed && !(depth_m < best_m)) continue;
            chosen = column;
            best_m = depth_m;
            best_is_smoothed = is_smoothed;
        }
    }
    return chosen;
}

/// What gnuplot draws without harm: one line, of a length that fits.
std::string tidyTitle(const std::string& title) {
    constexpr std::size_t kMost = 90;  // characters
    std::string tidy;
    std::size_t characters = 0;
    for (const char c : title) {
        const auto byte = static_cast<unsigned char>(c);
        if ((byte & 0xC0) != 0x80 && ++characters > kMost) return tidy + " ...";
        tidy += byte < 0x20 || byte == 0x7F ? ' ' : c;
    }
    return tidy;
}

/// The gnuplot script of all pictures: data first, each once, then panels that draw them.
class Script {
 public:
    explicit Script(const StageView& view)
        : view_(view),
          columns_(static_cast<int>(view.result.labels.cols())),
          rows_(static_cast<int>(view.result.labels.rows())),
          column_(columnToShow(view)),
          far_m_(std::max(view.options.zone_m, view.options.context_m)) {
        text_ << "set encoding utf8\n";
        writeData();
    }

    std::string str() const { return text_.str(); }

    void depthPicture() {
        beginPicture("1_depth.png", 330);
        heading("1  depth image (III-A)");
        depthImage({84, kWidth_px - 105, 60, 270}, "$depth", true);
        endPicture();
    }

    void maximaPicture() {
        beginPicture("2_maxima.png", 860);
        heading("2  persistent maxima of proximity (III-B)");
        maximaImage({84, kWidth_px - 105, 590, 800}, true);
        barcode({84, kWidth_px - 105, 60, 480});
        endPicture();
    }

    void mergedPicture() {
        beginPicture("3_merged.png", 660);
        heading("3  maxima sharpened and merged (III-B)");
        depthImage({84, kWidth_px - 105, 390, 600}, "$merged", true);
        zoomBefore({84, 570, 60, 270});
        zoomAfter({650, kWidth_px - 60, 60, 270});
        endPicture();
    }

    void rangeAnglePicture() {
        beginPicture("4_range_angle.png", 330);
        heading("4  range angle image (III-C)");
        angleImage({84, kWidth_px - 105, 60, 270}, "$angle", true, false);
        endPicture();
    }

    void smoothedPicture() {
        beginPicture("5_smoothed.png", 860);
        heading("5  singular spectrum analysis (III-D)");
        angleImage({84, kWidth_px - 105, 590, 800}, "$smoothed", true, true);
        series({84, 560, 60, 460});
        components({760, kWidth_px - 30, 60, 460});
        endPicture();
    }

    void labelPicture() {
        beginPicture("6_labels.png", 660);
        heading("6  regions of interest (III-E)");
        labelImage({84, kWidth_px - 105, 390, 580}, true);
        zoomLabels({84, kWidth_px - 105, 60, 270});
        endPicture();
    }

    void topPicture() {
        beginPicture("7_top_view.png", 960, 900);
        heading("7  the returns from above");
        topView({70, 880, 60, 870}, true);
        endPicture();
    }

    void overview() {
        const int height = 1540;
        beginPicture("stages.png", height);
        heading("Stages of the segmentation");
        const auto row = [&](int number) {
            const double top = height - 64.0 - 134.0 * number;
            return Box{84, kWidth_px - 105, top - 98, top};
        };
        panelTitle("1  depth image (III-A)");
        depthImage(row(0), "$depth", false);
        panelTitle("2  persistent maxima of proximity (III-B)");
        maximaImage(row(1), false);
        panelTitle("3  maxima sharpened and merged (III-B)");
        depthImage(row(2), "$merged", false);
        panelTitle("4  range angle image (III-C)");
        angleImage(row(3), "$angle", false, false);
        panelTitle("5  smoothed by singular spectrum analysis (III-D)");
        angleImage(row(4), "$smoothed", false, true);
        panelTitle("6  regions of interest (III-E)");
        labelImage(row(5), true);
        panelTitle("2  ");
        barcode({84, 540, 390, 600});
        panelTitle("5  ");
        components({150, 540, 60, 290});
        panelTitle("7  the returns from above");
        topView({640, 1180, 60, 600}, false);
        endPicture();
    }

 private:
    // ---- data ---------------------------------------------------------------------------------

    void writeData() {
        const SegmentationResult& r = view_.result;
        const float to_deg = static_cast<float>(degrees(1.0));
        // In a block nothing of it means anything to gnuplot; the mark in front, so that it cannot
        // end the block.
        block("$title", [&] { text_ << "|" << tidyTitle(view_.title) << "\n"; });
        text_ << "title = $title[1]\ntitle = title[2:*]\n";
        block("$depth", [&] { matrix(r.range_image.depth_m); });
        block("$repaired", [&] { matrix(r.repaired_m); });
        block("$merged", [&] { matrix(r.merged_m); });
        block("$angle", [&] { matrix(r.range_angle_rad * to_deg); });
        block("$smoothed", [&] { matrix(r.smoothed_rad * to_deg); });
        writeMaxima();
        writeColumn();
        writeLabels();
    }

    template <class Body>
    void block(const std::string& name, Body body) {
        text_ << name << " << END_OF_DATA\n";
        body();
        text_ << "END_OF_DATA\n";
    }

    void matrix(const Image<float>& image) {
        for (int row = 0; row < image.rows(); ++row) {
            for (int column = 0; column < image.cols(); ++column) {
                number(image(row, column));
                text_ << " ";
            }
            text_ << "\n";
        }
    }

    void number(float value) {
        if (hasValue(value)) {
            text_ << value;
        } else {
            text_ << "NaN";
        }
    }

    /// $maxima: column, row. $bars: rank, birth, death; the longest ones, from the oldest.
    void writeMaxima() {
        const auto& maxima = view_.result.maxima;
        block("$maxima", [&] {
            text_ << "NaN NaN\n";  // gnuplot refuses a block without a line
            for (const Maximum& m : maxima) {
                text_ << m.column << " " << m.row << "\n";
            }
        });
        std::vector<std::size_t> longest(maxima.size());
        for (std::size_t i = 0; i < longest.size(); ++i) longest[i] = i;
        std::stable_sort(longest.begin(), longest.end(), [&](std::size_t a, std::size_t b) {
            return maxima[a].persistence_m() > maxima[b].persistence_m();
        });
        bars_ = std::min<int>(static_cast<int>(longest.size()), kMostBars);
        longest.resize(static_cast<std::size_t>(bars_));
        std::sort(longest.begin(), longest.end());  // findPersistentMaxima() gives the oldest first
        block("$bars", [&] {
            text_ << "NaN NaN NaN\n";
            int rank = 0;
            for (const std::size_t i : longest) {
                text_ << ++rank << " " << maxima[i].birth_m << " " << maxima[i].death_m << "\n";
            }
        });
    }

    /// $before, $after: row, degrees. $elementary: row, value, one component after another.
    void writeColumn() {
        const SegmentationResult& r = view_.result;
        for (const auto& [name, image] :
             {std::pair{"$before", &r.range_angle_rad}, std::pair{"$after", &r.smoothed_rad}}) {
            block(name, [&, image = image] {
                for (int row = 0; row < image->rows(); ++row) {
                    text_ << row + 0.5 << " ";
                    number(
                        static_cast<float>(degrees(static_cast<double>((*image)(row, column_)))));
                    text_ << "\n";
                }
            });
        }
        const Run run = smoothedRun(r.range_angle_rad, column_, view_.options.window_size);
        if (run.rows == 0) return;
        const SeriesComponents found =
            decomposeSeries(r.range_angle_rad.col(column_).segment(run.first_row, run.rows),
                            view_.options.window_size);
        // Angles that are all zero have no components.
        const double all = std::max(found.eigenvalues.sum(), 1e-12);
        shares_ = std::min<int>(view_.options.window_size, kMostComponents);
        share_.assign(static_cast<std::size_t>(shares_), 0.0);
        block("$elementary", [&] {
            for (int c = 0; c < shares_; ++c) {
                share_[static_cast<std::size_t>(c)] = std::max(0.0, found.eigenvalues(c)) / all;
                const double most = found.elementary.col(c).cwiseAbs().maxCoeff();
                for (int i = 0; i < run.rows; ++i) {
                    const double value = found.elementary(i, c) / std::max(most, 1e-12);
                    text_ << run.first_row + i + 0.5 << " " << 0.4 * value - c << "\n";
                }
                text_ << "\n\n";
            }
        });
    }

    /// $labels: 0 ROU, 1 + colour for RoI. $rou, $unclassified, $roi: x, y, colour of RoI.
    void writeLabels() {
        const SegmentationResult& r = view_.result;
        // Returns are numbered anew (extractReturns), pixels take the colours of their returns.
        std::vector<std::int32_t> renumbered(static_cast<std::size_t>(r.components.maxCoeff()) + 1);
        for (std::size_t i = 0; i < renumbered.size(); ++i) {
            renumbered[i] = static_cast<std::int32_t>(i);
        }
        const auto& mapper = r.range_image.depth_mapper;
        for (std::size_t i = 0; i < mapper.size(); ++i) {
            const std::int32_t number = r.returns.component[i];
            if (mapper[i] == RangeImage::kNoPixel || number == 0) continue;
            renumbered[static_cast<std::size_t>(r.components.data()[mapper[i]])] = number;
        }
        Image<float> colours = Image<float>::Constant(rows_, columns_, kNoValue);
        for (int pixel = 0; pixel < rows_ * columns_; ++pixel) {
            const Label label = r.labels.data()[pixel];
            if (label == Label::Unclassified) continue;
            const auto component = static_cast<std::size_t>(r.components.data()[pixel]);
            colours.data()[pixel] = label == Label::Rou
                                        ? 0.0f
                                        : static_cast<float>(1 + colourOf(renumbered[component]));
        }
        block("$labels", [&] { matrix(colours); });

        half_width_m_ = 1.15f * view_.options.zone_m;
        const float pixel_m = half_width_m_ / 400;  // returns on one pixel are drawn once
        struct Point {
            int x_px, y_px;
            std::size_t colour;
            auto key() const { return std::tuple(x_px, y_px, colour); }
            bool operator<(const Point& other) const { return key() < other.key(); }
            bool operator==(const Point& other) const { return key() == other.key(); }
        };
        const auto points = [&](const char* name, const std::vector<std::uint32_t>& returns) {
            std::vector<Point> drawn;
            for (const std::uint32_t i : returns) {
                const float x_m = view_.scan.x_m[i], y_m = view_.scan.y_m[i];
                if (!(std::abs(x_m) < half_width_m_ && std::abs(y_m) < half_width_m_)) continue;
                drawn.push_back({static_cast<int>(std::lround(x_m / pixel_m)),
                                 static_cast<int>(std::lround(y_m / pixel_m)),
                                 colourOf(r.returns.component[i])});
            }
            std::sort(drawn.begin(), drawn.end());
            drawn.erase(std::unique(drawn.begin(), drawn.end()), drawn.end());
            block(name, [&] {
                text_ << "NaN NaN 0\n";
                for (const Point& p : drawn) {
                    text_ << static_cast<float>(p.x_px) * pixel_m << " "
                          << static_cast<float>(p.y_px) * pixel_m << " 0x"
                          << kRoiColours[p.colour] + 1 << "\n";  // "#RRGGBB" without its '#'
                }
            });
        };
        points("$rou", r.returns.rou);
        points("$unclassified", r.returns.unclassified);
        points("$roi", r.returns.roi);
    }

    // ---- panels -------------------------------------------------------------------------------

    void beginPicture(const std::string& name, int height_px, int width_px = kWidth_px) {
        width_px_ = width_px;
        height_px_ = height_px;
        text_ << "set terminal pngcairo size " << width_px << "," << height_px
              << " font 'sans,12' background '#FFFFFF'\nset output '" << name
              << "'\nset multiplot\n";
    }

    void endPicture() { text_ << "unset multiplot\nunset output\n"; }

    /// What stage this is, and on the right whose scan.
    void heading(const std::string& what) {
        heading_ = what;
        has_heading_ = true;
    }

    /// Goes above the next panel, behind what was said before.
    void panelTitle(const std::string& title) { panel_title_ += title; }

    /// Everything back to what all panels share, and what stands above this one.
    void beginPanel(const Box& box) {
        text_ << "reset\nset border lc rgb '" << kInk << "'\nset tics nomirror out scale 0.5\n"
              << "unset key\n"
              << "set lmargin at screen " << x(box.left) << "\nset rmargin at screen "
              << x(box.right) << "\nset bmargin at screen " << y(box.bottom)
              << "\nset tmargin at screen " << y(box.top) << "\n";
        if (has_heading_) {
            text_ << "set label '{/:Bold=14 " << heading_ << "}' at screen " << x(12) << ", screen "
                  << y(height_px_ - 22) << " left\nset label title at screen " << x(width_px_ - 12)
                  << ", screen " << y(height_px_ - 22) << " right noenhanced tc rgb '#666666'\n";
        }
        if (!panel_title_.empty()) {
            text_ << "set label '{/:Bold " << panel_title_ << "}' at screen " << x(box.left)
                  << ", screen " << y(box.top + 14) << " left\n";
        }
        has_heading_ = false;
        panel_title_.clear();
    }

    // Pixels as gnuplot's screen coordinates.
    double x(double pixels) const { return pixels / width_px_; }
    double y(double pixels) const { return pixels / height_px_; }

    /// A mark and a word to its right; gives where the next one may stand.
    double legendEntry(double left, double bottom, int mark, const std::string& colour,
                       const std::string& word) {
        text_ << "set label '" << word << "' at screen " << x(left) << ", screen " << y(bottom)
              << " left point pt " << mark << " ps " << (mark == 5 ? 1.5 : 1.0) << " lc rgb '"
              << colour << "' offset " << (word.empty() ? 0 : 1) << ",0\n";
        constexpr double kLetter_px = 8.2;
        return left + (word.empty() ? 14 : 36 + kLetter_px * static_cast<double>(word.size()));
    }

    /// The colours of labels, from here to the right; gives where the next entry may stand.
    double labelLegend(double left, double bottom) {
        for (std::size_t i = 0; i + 1 < kRoiColours.size(); ++i) {
            left = legendEntry(left, bottom, 5, kRoiColours[i], "");
        }
        left = legendEntry(left, bottom, 5, kRoiColours.back(), "RoI, a colour an obstacle");
        return legendEntry(left, bottom, 5, kRou, "ROU: ground, far");
    }

    /// Axes of an image: azimuth from left to right, beams from the lowest up. In columns and rows,
    /// for gnuplot is slow where it has to work out every pixel's place.
    void imageAxes(const Box& box, double from_deg, double to_deg, bool has_azimuth,
                   double first_row = 0.0) {
        beginPanel(box);
        text_ << "set object 1 rectangle from graph 0,0 to graph 1,1 fc rgb '" << kEmpty
              << "' fs solid noborder behind\nset xrange [" << columnAt(from_deg) << ":"
              << columnAt(to_deg) << "]\nset yrange [" << -0.5 - first_row << ":"
              << rows_ - 0.5 - first_row << "]\nset xtics (";
        const int step_deg = from_deg - to_deg > 180 ? 45 : 10;
        const int first_deg = static_cast<int>(std::floor(from_deg / step_deg)) * step_deg;
        for (int deg = first_deg; deg >= to_deg; deg -= step_deg) {
            text_ << (deg < first_deg ? ", " : "") << "'"
                  << (has_azimuth ? std::to_string(deg) : "") << "' " << columnAt(deg);
        }
        text_ << ")\nset ylabel 'elevation [deg]' offset 1,0\n";
        beamTics("y", box.top - box.bottom > 150 ? 6 : 4, first_row);
        if (has_azimuth) {
            text_
                << "set xlabel 'azimuth [deg], 0 straight ahead, left of the sensor on the left'\n";
        }
    }

    /// Where an azimuth lies between the columns, whose centres are whole numbers.
    double columnAt(double azimuth_deg) const {
        return columns_ * (0.5 - azimuth_deg / 360.0) - 0.5;
    }

    /// Elevations in degrees at up to `most` beams, evenly spaced from the lowest to the highest.
    void beamTics(const char* axis, int most, double first_row = 0.0) {
        int step = (rows_ - 1 + most - 2) / (most - 1);
        const int last = rows_ - 1;
        for (int even = step; even <= last / 2; ++even) {  // the highest beam too, where it goes
            if (last % even != 0) continue;
            step = even;
            break;
        }
        text_ << "set " << axis << "tics (";
        for (int row = 0; row < rows_; row += step) {
            const double elevation_deg = degrees(
                static_cast<double>(view_.sensor.elevations_rad[static_cast<std::size_t>(row)]));
            text_ << (row > 0 ? ", " : "") << "'" << std::round(elevation_deg * 10) / 10 + 0.0
                  << "' " << row - first_row;
        }
        text_ << ")\n";
    }

    void colourBar(const Box& box, const char* palette, float most, float step,
                   const std::string& what) {
        text_ << "set palette " << palette << "\nset cbrange [0:" << most << "]\nset cbtics "
              << step << "\nset cblabel '" << what << "'\nset colorbox user origin screen "
              << x(box.right + 12) << ", screen " << y(box.bottom) << " size screen " << x(16)
              << ", screen " << y(box.top - box.bottom) << " noborder\n";
    }

    static std::string imageOf(const std::string& block) {
        return "plot " + block + " matrix with image notitle";
    }

    void depthScale(const Box& box) {
        const float step = far_m_ > 100 ? 50.0f : far_m_ > 60 ? 20.0f : far_m_ > 25 ? 10.0f : 5.0f;
        colourBar(box, kDepthPalette, far_m_, step, "depth [m]");
    }

    void depthImage(const Box& box, const std::string& block, bool has_azimuth) {
        imageAxes(box, 180, -180, has_azimuth);
        depthScale(box);
        text_ << imageOf(block) << "\n";
    }

    void maximaImage(const Box& box, bool has_azimuth) {
        imageAxes(box, 180, -180, has_azimuth);
        depthScale(box);
        text_ << imageOf("$repaired")
              << ", $maxima using 1:2 with points pt 7 ps 0.75 lc rgb 'black' notitle, "
                 "$maxima using 1:2 with points pt 7 ps 0.45 lc rgb 'white' notitle\n";
    }

    void angleImage(const Box& box, const std::string& block, bool has_azimuth, bool has_mark) {
        imageAxes(box, 180, -180, has_azimuth, 0.5);  // an angle lies between two beams
        colourBar(box, kAnglePalette, 90, 30, "angle [deg]");
        if (has_mark) {
            // from above, where the axis has numbers; else from below, where no title is
            const double tip = has_azimuth ? box.top : box.bottom;
            const double tail = has_azimuth ? box.top + 22 : box.bottom - 12;
            text_ << "set arrow from " << column_ << ", screen " << y(tail) << " to " << column_
                  << ", screen " << y(tip)
                  << " filled size screen 0.007,25 lw 2 lc rgb '#D55E00' front\n";
        }
        text_ << imageOf(block) << "\n";
    }

    void labelScale() {
        text_ << "set palette maxcolors " << kRoiColours.size() + 1 << " defined (0 '" << kRou
              << "'";
        for (std::size_t i = 0; i < kRoiColours.size(); ++i) {
            text_ << ", " << i + 1 << " '" << kRoiColours[i] << "'";
        }
        text_ << ")\nset cbrange [0:" << kRoiColours.size() << "]\nunset colorbox\n";
    }

    void labelImage(const Box& box, bool has_azimuth) {
        imageAxes(box, 180, -180, has_azimuth);
        labelScale();
        legendEntry(labelLegend(box.right - 560, box.top + 14), box.top + 14, 5, kEmpty,
                    "no return");
        text_ << imageOf("$labels") << "\n";
    }

    std::string columnName() const {
        return "the column at " + oneDecimal(azimuthDeg(column_, columns_)) + " deg";
    }

    // Around the column whose components are shown, wide enough to see pixels.

    void zoomAxes(const Box& box) {
        const double middle_deg =
            std::clamp(azimuthDeg(column_, columns_), -180 + kZoomHalf_deg, 180 - kZoomHalf_deg);
        imageAxes(box, middle_deg + kZoomHalf_deg, middle_deg - kZoomHalf_deg, true);
        text_ << "set xlabel 'azimuth [deg]'\n";
    }

    void zoomDepth(const Box& box, const std::string& block) {
        zoomAxes(box);
        depthScale(box);
        text_ << "unset colorbox\n" << imageOf(block) << "\n";
    }

    void zoomBefore(const Box& box) {
        panelTitle("around " + columnName() + ", before");
        zoomDepth(box, "$repaired");
    }

    void zoomAfter(const Box& box) {
        panelTitle("after");
        zoomDepth(box, "$merged");
    }

    void zoomLabels(const Box& box) {
        panelTitle("around " + columnName());
        zoomAxes(box);
        labelScale();
        text_ << imageOf("$labels") << "\n";
    }

    void barcode(const Box& box) {
        const std::size_t number = view_.result.maxima.size();
        std::ostringstream title = plainText();
        if (number > static_cast<std::size_t>(bars_)) title << bars_ << " longest of ";
        title << number << (number == 1 ? " maximum" : " maxima");
        panelTitle(title.str() + " from birth to death");
        beginPanel(box);
        const float zone_m = view_.options.zone_m;
        text_ << "set xrange [" << zone_m << ":0]\nset yrange [" << std::max(bars_, 1) + 1
              << ":0]\nunset ytics\nset xlabel 'proximity [m]: the radius of the zone less the "
                 "depth'\n"
              << "plot $bars using 2:1:($3 - $2):(0) with vectors nohead lw "
              << std::clamp(0.6 * (box.top - box.bottom) / std::max(bars_, 1), 1.0, 6.0)
              << " lc rgb '#3B528B'\n";
    }

    void series(const Box& box) {
        panelTitle(columnName());
        beginPanel(box);
        // Smoothing may go below 0 and above 90.
        float least_deg = 0.0f, most_deg = 90.0f;
        for (const float angle_rad : view_.result.smoothed_rad.col(column_)) {
            if (!hasValue(angle_rad)) continue;
            const auto angle_deg = static_cast<float>(degrees(static_cast<double>(angle_rad)));
            least_deg = std::min(least_deg, angle_deg);
            most_deg = std::max(most_deg, angle_deg);
        }
        text_ << "set xrange [-0.5:" << rows_ - 0.5 << "]\nset yrange [" << least_deg - 5 << ":"
              << most_deg + 5 << "]\nset ytics 30\n"
              << "set xlabel 'elevation [deg]'\nset ylabel 'range angle [deg]'\n"
              << "set grid ytics lc rgb '#DDDDDD' lt 1\n"
              << "set key at graph 1, graph 1.01 right bottom horizontal samplen 1.5\n";
        beamTics("x", 6);
        text_ << "plot $before using 1:2 with linespoints pt 6 ps 1 lw 1.5 lc rgb '#888888' title "
                 "'before', $after using 1:2 with linespoints pt 7 ps 0.8 lw 2 lc rgb '#0072B2' "
                 "title 'after'\n";
    }

    void components(const Box& box) {
        const int kept = view_.options.principal_components;
        std::ostringstream title = plainText();
        title << "principal components, " << kept << " of " << view_.options.window_size
              << " kept (blue)";
        panelTitle(title.str());
        beginPanel(box);
        text_ << "set xrange [-0.5:" << rows_ - 0.5 << "]\nset yrange ["
              << -std::max(shares_, 1) + 0.4 << ":0.6]\n"
              << "set xlabel 'elevation [deg]'\nset ylabel 'component: its share of variance'\n";
        beamTics("x", 6);
        if (shares_ == 0) {
            text_
                << "unset ytics\nunset ylabel\nset label \"no run of " << view_.options.window_size
                << " angles without a gap:\\nthis column stays as it is\" at graph 0.5, graph 0.5 "
                   "center\nplot NaN notitle\n";
            return;
        }
        text_ << "set ytics (";
        for (int c = 0; c < shares_; ++c) {
            const double percent = 100 * share_[static_cast<std::size_t>(c)];
            const std::string share = percent < 0.05 ? "< 0.1" : oneDecimal(percent);
            text_ << (c > 0 ? ", " : "") << "'" << c + 1 << ":  " << share << " %%' " << -c;
        }
        text_ << ")\nset grid ytics lc rgb '#DDDDDD' lt 1\n"
              << "plot for [c=0:" << std::min(kept, shares_) - 1
              << "] $elementary index c using 1:2 with lines lw 2 lc rgb '#0072B2' notitle";
        if (kept < shares_) {
            text_ << ", for [c=" << kept << ":" << shares_ - 1
                  << "] $elementary index c using 1:2 with lines lw 2 dt (4,3) lc rgb '#888888' "
                     "notitle";
        }
        text_ << "\n";
    }

    void topView(const Box& box, bool has_legend) {
        beginPanel(box);
        const float zone_m = view_.options.zone_m;
        if (has_legend) {
            const double left = labelLegend(box.left + 8, box.top + 14);
            if (!view_.result.returns.unclassified.empty()) {
                legendEntry(left, box.top + 14, 2, kInk, "unclassified");
            }
        }
        text_ << "set xrange [" << half_width_m_ << ":" << -half_width_m_ << "]\nset yrange ["
              << -half_width_m_ << ":" << half_width_m_ << "]\n"
              << "set xlabel 'y, to the left [m]'\nset ylabel 'x, forward [m]' offset 1,0\n"
              << "set grid lc rgb '#EEEEEE' lt 1\nset object 1 circle at 0,0 size " << zone_m
              << " fs empty border lc rgb '#888888' dt 2\n"
              << "plot $rou using 2:1 with points pt 7 ps 0.25 lc rgb '" << kRou
              << "' notitle, $roi using 2:1:3 with points pt 7 ps 0.4 lc rgb variable notitle, "
                 "$unclassified using 2:1 with points pt 2 ps 0.5 lc rgb '"
              << kInk
              << "' notitle, '+' every ::::0 using (0):(0) with points pt 2 ps 2 lw 3 lc rgb "
                 "'black' notitle\n";
    }

    const StageView& view_;
    const int columns_, rows_;   ///< of the images
    const int column_;           ///< whose components are shown
    const float far_m_;          ///< end of the depth scale
    float half_width_m_ = 0.0f;  ///< of the top view
    int bars_ = 0, shares_ = 0;  ///< maxima and components that are drawn
    std::vector<double> share_;
    int width_px_ = 0, height_px_ = 0;
    bool has_heading_ = false;
    std::string heading_, panel_title_;
    std::ostringstream text_ = plainText();
};

}  // namespace

const std::vector<std::string>& stagePictures() {
    static const std::vector<std::string> kNames{
        "1_depth.png",    "2_maxima.png", "3_merged.png",   "4_range_angle.png",
        "5_smoothed.png", "6_labels.png", "7_top_view.png", "stages.png"};
    return kNames;
}

void drawStages(const StageView& view, const std::filesystem::path& folder) {
    Script script(view);
    script.depthPicture();
    script.maximaPicture();
    script.mergedPicture();
    script.rangeAnglePicture();
    script.smoothedPicture();
    script.labelPicture();
    script.topPicture();
    script.overview();
    runGnuplot(script.str(), folder, stagePictures());
}

}  // namespace hagen
