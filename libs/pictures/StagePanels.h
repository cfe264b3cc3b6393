#pragma once
#include <hagen/pictures/StagePictures.h>
#include <sstream>
#include <string>

#include "GnuplotText.h"
#include "StageData.h"

namespace hagen::pictures {

/// A place in a picture, in pixels from its lower left corner.
struct Box {
    double left, right, bottom, top;
};

/// The gnuplot script of pictures, panel by panel: each draws a block of the data.
class Panels {
 public:
    static constexpr int kWidth_px = 1200;  ///< of most pictures

    /// Refers to both.
    Panels(const StageView& view, const StageData& data);

    std::string script() const { return text_.str(); }

    void beginPicture(const std::string& name, int height_px, int width_px = kWidth_px);
    void endPicture();
    /// What stage this is, and on the right whose scan.
    void heading(const std::string& what);
    /// Goes above the next panel, behind what was said before.
    void panelTitle(const std::string& title);
    void depthImage(const Box& box, const std::string& block, bool has_azimuth);
    void maximaImage(const Box& box, bool has_azimuth);
    void angleImage(const Box& box, const std::string& block, bool has_azimuth, bool has_mark);
    void labelImage(const Box& box, bool has_azimuth);
    void zoomBefore(const Box& box);
    void zoomAfter(const Box& box);
    void zoomLabels(const Box& box);
    void barcode(const Box& box);
    void series(const Box& box);
    void components(const Box& box);
    void topView(const Box& box, bool has_legend);

 private:
    /// Everything back to what all panels share, and what stands above this one.
    void beginPanel(const Box& box);
    // Pixels as gnuplot's screen coordinates.
    double x(double pixels) const;
    double y(double pixels) const;
    /// A mark and a word to its right; gives where the next one may stand.
    double legendEntry(double left, double bottom, int mark, const std::string& colour,
                       const std::string& word);
    /// The colours of labels, from here to the right; gives where the next entry may stand.
    double labelLegend(double left, double bottom);
    /// Axes of an image: azimuth from left to right, beams from the lowest up. In columns and rows,
    /// for gnuplot is slow where it has to work out every pixel's place.
    void imageAxes(const Box& box, double from_deg, double to_deg, bool has_azimuth,
                   double first_row = 0.0);
    /// Where an azimuth lies between the columns, whose centres are whole numbers.
    double columnAt(double azimuth_deg) const;
    /// Elevations in degrees at up to `most` beams, evenly spaced from the lowest to the highest.
    void beamTics(const char* axis, int most, double first_row = 0.0);
    void colourBar(const Box& box, const char* palette, float most, float step,
                   const std::string& what);
    static std::string imageOf(const std::string& block);
    void depthScale(const Box& box);
    void labelScale();
    std::string columnName() const;
    // Around the column whose components are shown, wide enough to see pixels.
    void zoomAxes(const Box& box);
    void zoomDepth(const Box& box, const std::string& block);

    const StageView& view_;
    const StageData& data_;
    const int columns_, rows_;  ///< of the images
    const float far_m_;         ///< end of the depth scale
    int width_px_ = 0, height_px_ = 0;
    bool has_heading_ = false;
    std::string heading_, panel_title_;
    std::ostringstream text_ = plainText();
};

}  // namespace hagen::pictures
