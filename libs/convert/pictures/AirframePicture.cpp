#include "convert/pictures/AirframePicture.h"
#include "convert/pictures/Gnuplot.h"

#include "convert/pictures/GnuplotText.h"

namespace hagen::convert {

void drawAirframe(const Image<float>& bin_range_m, const std::string& title,
                  const std::filesystem::path& folder, const std::string& name) {
    const double bin_deg = 180.0 / static_cast<double>(bin_range_m.rows());
    GnuplotStream text;
    text << "$range << EOD\n";
    for (Eigen::Index row = 0; row < bin_range_m.rows(); ++row) {
        for (Eigen::Index column = 0; column < bin_range_m.cols(); ++column) {
            const float range_m = bin_range_m(row, column);
            if (range_m > 0) {
                text << range_m << " ";
            } else {
                text << "NaN ";
            }
        }
        text << "\n";
    }
    const float farthest_m = std::max(bin_range_m.maxCoeff(), 0.1f);
    text << "EOD\nset encoding utf8\nset terminal pngcairo size 1000,560 font 'sans,12' background "
            "'#FFFFFF'\nset output "
         << gnuplotString(name) << "\nset title " << gnuplotString(title)
         << " noenhanced\nset border lc rgb '" << kInk
         << "'\nset tics nomirror out scale 0.5\nset xrange [180:-180]\nset yrange [-90:90]\n"
         << "set xtics 45\nset ytics 30\nset grid xtics ytics front lc rgb '#BBBBBB' lt 1\n"
         << "set size ratio -1\n"
         << "set xlabel 'azimuth [deg], 0 straight ahead, left of the sensor on the left'\n"
         << "set ylabel 'elevation [deg]'\nset cblabel 'masked up to [m]'\n"
         << "set object 1 rectangle from graph 0,0 to graph 1,1 fc rgb '" << kEmpty
         << "' fs solid noborder behind\nset cbrange [0:" << farthest_m << "]\n"
         << "set palette defined (0 '#440154', 1 '#3B528B', 2 '#21918C', 3 '#5EC962', 4 "
            "'#FDE725')\n"
         << "plot $range matrix using (-180 + " << bin_deg << " * ($1 + 0.5)):(-90 + " << bin_deg
         << " * ($2 + 0.5)):3 with image pixels notitle\nunset output\n";
    runGnuplot(text.str(), folder, {name});
}

}  // namespace hagen::convert
