#pragma once
#include <string>
#include "convert/pictures/StagePictures.h"

#include "convert/pictures/GnuplotText.h"
#include "convert/pictures/StageData.h"

namespace hagen::convert {

/// A rectangle in a picture, in pixels from the lower left corner.
struct Box {
    double left, right, bottom, top;
};

/// Writes a gnuplot script panel by panel; each panel draws a data block.
class StagePanelWriter {
 public:
    static constexpr int kWidth_px = 1200;  ///< width of most pictures

    /// Keeps references to both arguments.
    StagePanelWriter(const StageView& view, const StageData& data);

    std::string script() const { return text_.str(); }

    /// Begins a picture with a heading (left) and the scan's title (right).
    void beginPicture(const std::string& name, const std::string& heading, int height_px,
                      int width_px = kWidth_px);
    void endPicture();
    /// Sets the title of the next panel, appended to the previous text.
    void panelTitle(const std::string& title);
    void depthImage(const Box& box, const std::string& block, bool has_azimuth);
    void maximaImage(const Box& box, bool has_azimuth);
    void angleImage(const Box& box, const std::string& block, bool has_azimuth, bool has_mark);
    void labelImage(const Box& box, bool has_azimuth);
    void angleBefore(const Box& box);
    void angleAfter(const Box& box);
    void zoomLabels(const Box& box);
    void barcode(const Box& box);
    void series(const Box& box);
    void components(const Box& box);
    void topView(const Box& box, bool has_legend);

 private:
    /// Resets all shared settings, and draws the titles of this panel.
    void beginPanel(const Box& box);
    // Convert pixels to gnuplot's screen coordinates.
    double x(double pixels) const;
    double y(double pixels) const;
    /// Draws a mark and a word to its right; returns the position of the next entry.
    double legendEntry(double left, double bottom, int mark, const std::string& colour,
                       const std::string& word);
    /// Draws the colours of labels from `left` to the right; returns the position of the next
    /// entry.
    double labelLegend(double left, double bottom);
    /// Draws the axes of an image: azimuth from left to right, lowest beam at the bottom. Uses
    /// columns and rows, because gnuplot is slow at computing pixel positions.
    void imageAxes(const Box& box, double from_deg, double to_deg, bool has_azimuth,
                   double first_row = 0.0);
    /// Fractional column of an azimuth; column centres are integers.
    double columnAt(double azimuth_deg) const;
    /// Labels up to `max` beams by elevation in degrees, evenly spaced from the lowest to the
    /// highest.
    void beamTics(const char* axis, int max, double first_row = 0.0);
    void colourBar(const Box& box, const char* palette, float max, float step,
                   const std::string& what);
    static std::string imageOf(const std::string& block);
    void depthScale(const Box& box);
    void labelScale();
    std::string columnName() const;
    // Draws axes around the selected column, zoomed in until pixels are visible.
    void zoomAxes(const Box& box);
    void zoomDepth(const Box& box, const std::string& block);

    const StageView& view_;
    const StageData& data_;
    const int columns_, rows_;  ///< size of the images
    const float far_m_;         ///< upper end of the depth scale
    int width_px_ = 0, height_px_ = 0;
    bool has_heading_ = false;
    std::string heading_, panel_title_;
    GnuplotStream text_;
};

}  // namespace hagen::convert
