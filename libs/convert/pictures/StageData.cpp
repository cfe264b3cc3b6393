#include "convert/pictures/StageData.h"

#include <hagen/scan/Angle.h>
#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>
#include "filter/paper/SingularSpectrumAnalysis.h"

#include "convert/pictures/GnuplotText.h"

namespace hagen::convert {
namespace {

constexpr int kMaxBars = 60;
constexpr int kMaxComponents = 12;

std::size_t colourOf(std::int32_t component) {
    return static_cast<std::size_t>(std::max(component, 1) - 1) % kRoiColours.size();
}

/// The longest contiguous segment of a column's angles; empty if shorter than the window.
struct Run {
    int first_row = 0, rows = 0;
};
Run longestSmoothedRun(const Image<float>& angles, int column, int window_size) {
    Run longest;
    const int rows = static_cast<int>(angles.rows());
    for (int row = 0, first = 0; row <= rows; ++row) {
        if (row < rows && hasValue(angles(row, column))) continue;
        if (row - first > longest.rows) longest = {first, row - first};
        first = row + 1;
    }
    return longest.rows >= window_size ? longest : Run();
}

int selectedColumn(const StageView& view) {
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
            longestSmoothedRun(r.range_angle_rad, column, view.options.window_size).rows > 0;
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

/// Makes a title that gnuplot can draw: one line of limited length.
std::string sanitizedTitle(const std::string& title) {
    constexpr std::size_t kMax = 90;  // characters
    std::string tidy;
    std::size_t characters = 0;
    for (const char c : title) {
        const auto byte = static_cast<unsigned char>(c);
        if ((byte & 0xC0) != 0x80 && ++characters > kMax) return tidy + " ...";
        tidy += byte < 0x20 || byte == 0x7F ? ' ' : c;
    }
    return tidy;
}

class DataBlockWriter {
 public:
    explicit DataBlockWriter(const StageView& view)
        : view_(view),
          columns_(static_cast<int>(view.result.labels.cols())),
          rows_(static_cast<int>(view.result.labels.rows())) {
        data_.column = selectedColumn(view);
    }

    StageData write() {
        const SegmentationResult& r = view_.result;
        const float to_deg = static_cast<float>(degrees(1.0));
        // Text in a block is never interpreted by gnuplot; the leading mark prevents it from ending
        // the block.
        block("$title", [&] { text_ << "|" << sanitizedTitle(view_.title) << "\n"; });
        text_ << "title = $title[1]\ntitle = title[2:*]\n";
        block("$depth", [&] { matrix(r.range_image.depth_m); });
        block("$repaired", [&] { matrix(r.repaired_m); });
        block("$merged", [&] { matrix(r.merged_m); });
        block("$angle", [&] { matrix(r.range_angle_rad * to_deg); });
        block("$smoothed", [&] { matrix(r.smoothed_rad * to_deg); });
        writeMaxima();
        writeColumn();
        writeLabels();
        data_.blocks = text_.str();
        return data_;
    }

 private:
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

    /// $maxima: column, row. $bars: rank, birth, death; the longest bars, oldest first.
    void writeMaxima() {
        const auto& maxima = view_.result.maxima;
        block("$maxima", [&] {
            text_ << "NaN NaN\n";  // gnuplot rejects an empty block
            for (const Maximum& m : maxima) {
                text_ << m.column << " " << m.row << "\n";
            }
        });
        std::vector<std::size_t> longest(maxima.size());
        for (std::size_t i = 0; i < longest.size(); ++i) longest[i] = i;
        std::stable_sort(longest.begin(), longest.end(), [&](std::size_t a, std::size_t b) {
            return maxima[a].persistence_m() > maxima[b].persistence_m();
        });
        data_.bars = std::min<int>(static_cast<int>(longest.size()), kMaxBars);
        longest.resize(static_cast<std::size_t>(data_.bars));
        std::sort(longest.begin(),
                  longest.end());  // findPersistentMaxima() returns the oldest maxima first
        block("$bars", [&] {
            text_ << "NaN NaN NaN\n";
            int rank = 0;
            for (const std::size_t i : longest) {
                text_ << ++rank << " " << maxima[i].birth_m << " " << maxima[i].death_m << "\n";
            }
        });
    }

    /// $before, $after: row, degrees. $elementary: row, value, component by component.
    void writeColumn() {
        const SegmentationResult& r = view_.result;
        for (const auto& [name, image] :
             {std::pair{"$before", &r.range_angle_rad}, std::pair{"$after", &r.smoothed_rad}}) {
            block(name, [&, image = image] {
                for (int row = 0; row < image->rows(); ++row) {
                    text_ << row + 0.5 << " ";
                    number(static_cast<float>(
                        degrees(static_cast<double>((*image)(row, data_.column)))));
                    text_ << "\n";
                }
            });
        }
        const Run run =
            longestSmoothedRun(r.range_angle_rad, data_.column, view_.options.window_size);
        if (run.rows == 0) return;
        const SeriesComponents found =
            decomposeSeries(r.range_angle_rad.col(data_.column).segment(run.first_row, run.rows),
                            view_.options.window_size);
        // Avoids division by zero: if all angles are zero, there are no components.
        const double all = std::max(found.eigenvalues.sum(), 1e-12);
        const int components = std::min<int>(view_.options.window_size, kMaxComponents);
        block("$elementary", [&] {
            for (int c = 0; c < components; ++c) {
                data_.component_share.push_back(std::max(0.0, found.eigenvalues(c)) / all);
                const double max = found.elementary.col(c).cwiseAbs().maxCoeff();
                for (int i = 0; i < run.rows; ++i) {
                    const double value = found.elementary(i, c) / std::max(max, 1e-12);
                    text_ << run.first_row + i + 0.5 << " " << 0.4 * value - c << "\n";
                }
                text_ << "\n\n";
            }
        });
    }

    /// $labels: 0 ROU, 1 + colour for RoI. $rou, $unclassified, $roi: x, y, colour of RoI.
    void writeLabels() {
        const SegmentationResult& r = view_.result;
        // extractReturns renumbers obstacles; pixels take the colours of their returns.
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

        data_.half_width_m = 1.15f * view_.options.zone_m;
        const float pixel_m =
            data_.half_width_m / 400;  // so that several returns on one pixel are drawn once
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
                if (!(std::abs(x_m) < data_.half_width_m && std::abs(y_m) < data_.half_width_m))
                    continue;
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

    const StageView& view_;
    const int columns_, rows_;  ///< size of the images
    StageData data_;
    GnuplotStream text_;
};

}  // namespace

StageData stageDataOf(const StageView& view) { return DataBlockWriter(view).write(); }

}  // namespace hagen::convert
