#include "convert/pictures/StagePanels.h"

#include <hagen/scan/Angle.h>
#include <algorithm>
#include <cmath>

namespace hagen::convert {
namespace {

/// Perceptually uniform palettes: viridis for depths, cividis for angles.
constexpr const char* kDepthPalette =
    "defined (0 '#440154', 1 '#472D7B', 2 '#3B528B', 3 '#2C728E', 4 '#21918C', 5 '#28AE80', "
    "6 '#5EC962', 7 '#ADDC30', 8 '#FDE725')";
constexpr const char* kAnglePalette =
    "defined (0 '#00224E', 1 '#123570', 2 '#3B496C', 3 '#575D6D', 4 '#707173', 5 '#8A8678', "
    "6 '#A59C74', 7 '#C3B369', 8 '#E1CC55', 9 '#FEE838')";

constexpr double kZoomHalf_deg = 30.0;

std::string oneDecimal(double value) {
    GnuplotStream text;
    text.setf(std::ios::fixed);
    text.precision(1);
    text << value;
    return text.str();
}

double azimuthDeg(int column, int columns) {
    return degrees(static_cast<double>(columnAzimuth(column, columns)));
}

}  // namespace

StagePanelWriter::StagePanelWriter(const StageView& view, const StageData& data)
    : view_(view),
      data_(data),
      columns_(static_cast<int>(view.result.labels.cols())),
      rows_(static_cast<int>(view.result.labels.rows())),
      far_m_(std::max(view.options.zone_m,
                      std::min(view.options.context_m, view.sensor.max_range_m))) {
    text_ << "set encoding utf8\n" << data.blocks;
}

void StagePanelWriter::beginPicture(const std::string& name, const std::string& heading,
                                    int height_px, int width_px) {
    heading_ = heading;
    has_heading_ = true;
    width_px_ = width_px;
    height_px_ = height_px;
    text_ << "set terminal pngcairo size " << width_px << "," << height_px
          << " font 'sans,12' background '#FFFFFF'\nset output '" << name << "'\nset multiplot\n";
}

void StagePanelWriter::endPicture() { text_ << "unset multiplot\nunset output\n"; }

void StagePanelWriter::panelTitle(const std::string& title) { panel_title_ += title; }

void StagePanelWriter::depthImage(const Box& box, const std::string& block, bool has_azimuth) {
    imageAxes(box, 180, -180, has_azimuth);
    depthScale(box);
    text_ << imageOf(block) << "\n";
}

void StagePanelWriter::maximaImage(const Box& box, bool has_azimuth) {
    imageAxes(box, 180, -180, has_azimuth);
    depthScale(box);
    text_ << imageOf("$repaired")
          << ", $maxima using 1:2 with points pt 7 ps 0.75 lc rgb 'black' notitle, "
             "$maxima using 1:2 with points pt 7 ps 0.45 lc rgb 'white' notitle\n";
}

void StagePanelWriter::angleImage(const Box& box, const std::string& block, bool has_azimuth,
                                  bool has_mark) {
    imageAxes(box, 180, -180, has_azimuth, 0.5);  // 0.5, because an angle lies between two beams
    colourBar(box, kAnglePalette, 90, 30, "angle [deg]");
    if (has_mark) {
        // The arrow points from above if the axis has numbers, otherwise from below, where there is
        // no title.
        const double tip = has_azimuth ? box.top : box.bottom;
        const double tail = has_azimuth ? box.top + 22 : box.bottom - 12;
        text_ << "set arrow from " << data_.column << ", screen " << y(tail) << " to "
              << data_.column << ", screen " << y(tip)
              << " filled size screen 0.007,25 lw 2 lc rgb '#D55E00' front\n";
    }
    text_ << imageOf(block) << "\n";
}

void StagePanelWriter::labelImage(const Box& box, bool has_azimuth) {
    imageAxes(box, 180, -180, has_azimuth);
    labelScale();
    legendEntry(labelLegend(box.right - 560, box.top + 14), box.top + 14, 5, kEmpty, "no return");
    text_ << imageOf("$labels") << "\n";
}

void StagePanelWriter::angleBefore(const Box& box) {
    panelTitle("around " + columnName() + ", before");
    zoomDepth(box, "$repaired");
}

void StagePanelWriter::angleAfter(const Box& box) {
    panelTitle("after");
    zoomDepth(box, "$merged");
}

void StagePanelWriter::zoomLabels(const Box& box) {
    panelTitle("around " + columnName());
    zoomAxes(box);
    labelScale();
    text_ << imageOf("$labels") << "\n";
}

void StagePanelWriter::barcode(const Box& box) {
    const std::size_t number = view_.result.maxima.size();
    GnuplotStream title;
    if (number > static_cast<std::size_t>(data_.bars)) title << data_.bars << " longest of ";
    title << number << (number == 1 ? " maximum" : " maxima");
    panelTitle(title.str() + " from birth to death");
    beginPanel(box);
    const float zone_m = view_.options.zone_m;
    text_ << "set xrange [" << zone_m << ":0]\nset yrange [" << std::max(data_.bars, 1) + 1
          << ":0]\nunset ytics\nset xlabel 'proximity [m]: zone radius minus the "
             "depth'\n"
          << "plot $bars using 2:1:($3 - $2):(0) with vectors nohead lw "
          << std::clamp(0.6 * (box.top - box.bottom) / std::max(data_.bars, 1), 1.0, 6.0)
          << " lc rgb '#3B528B'\n";
}

void StagePanelWriter::series(const Box& box) {
    panelTitle(columnName());
    beginPanel(box);
    // Smoothing may exceed the range 0 to 90.
    float min_deg = 0.0f, max_deg = 90.0f;
    for (const float angle_rad : view_.result.smoothed_rad.col(data_.column)) {
        if (!hasValue(angle_rad)) continue;
        const auto angle_deg = static_cast<float>(degrees(static_cast<double>(angle_rad)));
        min_deg = std::min(min_deg, angle_deg);
        max_deg = std::max(max_deg, angle_deg);
    }
    text_ << "set xrange [-0.5:" << rows_ - 0.5 << "]\nset yrange [" << min_deg - 5 << ":"
          << max_deg + 5 << "]\nset ytics 30\n"
          << "set xlabel 'elevation [deg]'\nset ylabel 'range angle [deg]'\n"
          << "set grid ytics lc rgb '#DDDDDD' lt 1\n"
          << "set key at graph 1, graph 1.01 right bottom horizontal samplen 1.5\n";
    beamTics("x", 6);
    text_ << "plot $before using 1:2 with linespoints pt 6 ps 1 lw 1.5 lc rgb '#888888' title "
             "'before', $after using 1:2 with linespoints pt 7 ps 0.8 lw 2 lc rgb '#0072B2' "
             "title 'after'\n";
}

void StagePanelWriter::components(const Box& box) {
    const int shares = static_cast<int>(data_.component_share.size());
    const int kept = view_.options.principal_components;
    GnuplotStream title;
    title << "principal components, " << kept << " of " << view_.options.window_size
          << " kept (blue)";
    panelTitle(title.str());
    beginPanel(box);
    text_ << "set xrange [-0.5:" << rows_ - 0.5 << "]\nset yrange [" << -std::max(shares, 1) + 0.4
          << ":0.6]\n"
          << "set xlabel 'elevation [deg]'\nset ylabel 'component: fraction of variance'\n";
    beamTics("x", 6);
    if (shares == 0) {
        text_ << "unset ytics\nunset ylabel\nset label \"no segment of "
              << view_.options.window_size
              << " angles without a gap:\\nthis column is unchanged\" at graph 0.5, graph 0.5 "
                 "center\nplot NaN notitle\n";
        return;
    }
    text_ << "set ytics (";
    for (int c = 0; c < shares; ++c) {
        const double percent = 100 * data_.component_share[static_cast<std::size_t>(c)];
        const std::string share = percent < 0.05 ? "< 0.1" : oneDecimal(percent);
        text_ << (c > 0 ? ", " : "") << "'" << c + 1 << ":  " << share << " %%' " << -c;
    }
    text_ << ")\nset grid ytics lc rgb '#DDDDDD' lt 1\n"
          << "plot for [c=0:" << std::min(kept, shares) - 1
          << "] $elementary index c using 1:2 with lines lw 2 lc rgb '#0072B2' notitle";
    if (kept < shares) {
        text_ << ", for [c=" << kept << ":" << shares - 1
              << "] $elementary index c using 1:2 with lines lw 2 dt (4,3) lc rgb '#888888' "
                 "notitle";
    }
    text_ << "\n";
}

void StagePanelWriter::topView(const Box& box, bool has_legend) {
    beginPanel(box);
    const float zone_m = view_.options.zone_m;
    if (has_legend) {
        const double left = labelLegend(box.left + 8, box.top + 14);
        if (!view_.result.returns.unclassified.empty()) {
            legendEntry(left, box.top + 14, 2, kInk, "unclassified");
        }
    }
    text_ << "set xrange [" << data_.half_width_m << ":" << -data_.half_width_m << "]\nset yrange ["
          << -data_.half_width_m << ":" << data_.half_width_m << "]\n"
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

void StagePanelWriter::beginPanel(const Box& box) {
    text_ << "reset\nset border lc rgb '" << kInk << "'\nset tics nomirror out scale 0.5\n"
          << "unset key\n"
          << "set lmargin at screen " << x(box.left) << "\nset rmargin at screen " << x(box.right)
          << "\nset bmargin at screen " << y(box.bottom) << "\nset tmargin at screen " << y(box.top)
          << "\n";
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

double StagePanelWriter::x(double pixels) const { return pixels / width_px_; }

double StagePanelWriter::y(double pixels) const { return pixels / height_px_; }

double StagePanelWriter::legendEntry(double left, double bottom, int mark,
                                     const std::string& colour, const std::string& word) {
    text_ << "set label '" << word << "' at screen " << x(left) << ", screen " << y(bottom)
          << " left point pt " << mark << " ps " << (mark == 5 ? 1.5 : 1.0) << " lc rgb '" << colour
          << "' offset " << (word.empty() ? 0 : 1) << ",0\n";
    constexpr double kLetter_px = 8.2;
    return left + (word.empty() ? 14 : 36 + kLetter_px * static_cast<double>(word.size()));
}

double StagePanelWriter::labelLegend(double left, double bottom) {
    for (std::size_t i = 0; i + 1 < kRoiColours.size(); ++i) {
        left = legendEntry(left, bottom, 5, kRoiColours[i], "");
    }
    left = legendEntry(left, bottom, 5, kRoiColours.back(), "RoI, one colour per obstacle");
    return legendEntry(left, bottom, 5, kRou, "ROU: ground, far");
}

void StagePanelWriter::imageAxes(const Box& box, double from_deg, double to_deg, bool has_azimuth,
                                 double first_row) {
    beginPanel(box);
    text_ << "set object 1 rectangle from graph 0,0 to graph 1,1 fc rgb '" << kEmpty
          << "' fs solid noborder behind\nset xrange [" << columnAt(from_deg) << ":"
          << columnAt(to_deg) << "]\nset yrange [" << -0.5 - first_row << ":"
          << rows_ - 0.5 - first_row << "]\nset xtics (";
    const int step_deg = from_deg - to_deg > 180 ? 45 : 10;
    const int first_deg = static_cast<int>(std::floor(from_deg / step_deg)) * step_deg;
    for (int deg = first_deg; deg >= to_deg; deg -= step_deg) {
        text_ << (deg < first_deg ? ", " : "") << "'" << (has_azimuth ? std::to_string(deg) : "")
              << "' " << columnAt(deg);
    }
    text_ << ")\nset ylabel 'elevation [deg]' offset 1,0\n";
    beamTics("y", box.top - box.bottom > 150 ? 6 : 4, first_row);
    if (has_azimuth) {
        text_ << "set xlabel 'azimuth [deg], 0 straight ahead, left of the sensor on the left'\n";
    }
}

double StagePanelWriter::columnAt(double azimuth_deg) const {
    return columns_ * (0.5 - azimuth_deg / 360.0) - 0.5;
}

void StagePanelWriter::beamTics(const char* axis, int max, double first_row) {
    int step = (rows_ - 1 + max - 2) / (max - 1);
    const int last = rows_ - 1;
    // Labels the highest beam too if the step allows it.
    for (int even = step; even <= last / 2; ++even) {
        if (last % even != 0) continue;
        step = even;
        break;
    }
    text_ << "set " << axis << "tics (";
    for (int row = 0; row < rows_; row += step) {
        const double elevation_deg = degrees(
            static_cast<double>(view_.sensor.elevations_rad[static_cast<std::size_t>(row)]));
        text_ << (row > 0 ? ", " : "") << "'" << std::round(elevation_deg * 10) / 10 + 0.0 << "' "
              << row - first_row;
    }
    text_ << ")\n";
}

void StagePanelWriter::colourBar(const Box& box, const char* palette, float max, float step,
                                 const std::string& what) {
    text_ << "set palette " << palette << "\nset cbrange [0:" << max << "]\nset cbtics " << step
          << "\nset cblabel '" << what << "'\nset colorbox user origin screen " << x(box.right + 12)
          << ", screen " << y(box.bottom) << " size screen " << x(16) << ", screen "
          << y(box.top - box.bottom) << " noborder\n";
}

std::string StagePanelWriter::imageOf(const std::string& block) {
    return "plot " + block + " matrix with image notitle";
}

void StagePanelWriter::depthScale(const Box& box) {
    const float step = far_m_ > 100 ? 50.0f : far_m_ > 60 ? 20.0f : far_m_ > 25 ? 10.0f : 5.0f;
    colourBar(box, kDepthPalette, far_m_, step, "depth [m]");
}

void StagePanelWriter::labelScale() {
    text_ << "set palette maxcolors " << kRoiColours.size() + 1 << " defined (0 '" << kRou << "'";
    for (std::size_t i = 0; i < kRoiColours.size(); ++i) {
        text_ << ", " << i + 1 << " '" << kRoiColours[i] << "'";
    }
    text_ << ")\nset cbrange [0:" << kRoiColours.size() << "]\nunset colorbox\n";
}

std::string StagePanelWriter::columnName() const {
    return "the column at " + oneDecimal(azimuthDeg(data_.column, columns_)) + " deg";
}

void StagePanelWriter::zoomAxes(const Box& box) {
    const double middle_deg =
        std::clamp(azimuthDeg(data_.column, columns_), -180 + kZoomHalf_deg, 180 - kZoomHalf_deg);
    imageAxes(box, middle_deg + kZoomHalf_deg, middle_deg - kZoomHalf_deg, true);
    text_ << "set xlabel 'azimuth [deg]'\n";
}

void StagePanelWriter::zoomDepth(const Box& box, const std::string& block) {
    zoomAxes(box);
    depthScale(box);
    text_ << "unset colorbox\n" << imageOf(block) << "\n";
}

}  // namespace hagen::convert
