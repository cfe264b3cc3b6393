set encoding utf8
$title << END_OF_DATA
END_OF_DATA
title = $title[1]
title = title[2:*]
$depth << END_OF_DATA
END_OF_DATA
$repaired << END_OF_DATA
END_OF_DATA
$merged << END_OF_DATA
END_OF_DATA
$angle << END_OF_DATA
END_OF_DATA
$smoothed << END_OF_DATA
END_OF_DATA
$maxima << END_OF_DATA
END_OF_DATA
$bars << END_OF_DATA
END_OF_DATA
$before << END_OF_DATA
END_OF_DATA
$after << END_OF_DATA
END_OF_DATA
$elementary << END_OF_DATA
END_OF_DATA
$labels << END_OF_DATA
END_OF_DATA
$rou << END_OF_DATA
END_OF_DATA
$unclassified << END_OF_DATA
END_OF_DATA
$roi << END_OF_DATA
END_OF_DATA
set terminal pngcairo size 1200,330 font 'sans,12' background '#FFFFFF'
set output '1_depth.png'
set multiplot
reset
set border lc rgb '#333333'
set tics nomirror out scale 0.5
unset key
set lmargin at screen 0.07
set rmargin at screen 0.9125
set bmargin at screen 0.18182
set tmargin at screen 0.81818
set label '{/:Bold=14 1  depth image (III-A)}' at screen 0.01, screen 0.93333 left
set label title at screen 0.99, screen 0.93333 right noenhanced tc rgb '#666666'
set object 1 rectangle from graph 0,0 to graph 1,1 fc rgb '#E9E9E9' fs solid noborder behind
set xrange [-0.5:869.5]
set yrange [-0.5:15.5]
set xtics ('180' -0.5, '135' 108.25, '90' 217, '45' 325.75, '0' 434.5, '-45' 543.25, '-90' 652, '-135' 760.75, '-180' 869.5)
set ylabel 'elevation [deg]' offset 1,0
set ytics ('-15' 0, '-9' 3, '-3' 6, '3' 9, '9' 12, '15' 15)
set xlabel 'azimuth [deg], 0 straight ahead, left of the sensor on the left'
set palette defined (0 '#440154', 1 '#472D7B', 2 '#3B528B', 3 '#2C728E', 4 '#21918C', 5 '#28AE80', 6 '#5EC962', 7 '#ADDC30', 8 '#FDE725')
set cbrange [0:48]
set cbtics 10
set cblabel 'depth [m]'
set colorbox user origin screen 0.9225, screen 0.18182 size screen 0.013333, screen 0.63636 noborder
plot $depth matrix with image notitle
unset multiplot
unset output
set terminal pngcairo size 1200,860 font 'sans,12' background '#FFFFFF'
set output '2_maxima.png'
set multiplot
reset
set border lc rgb '#333333'
set tics nomirror out scale 0.5
unset key
set lmargin at screen 0.07
set rmargin at screen 0.9125
set bmargin at screen 0.68605
set tmargin at screen 0.93023
set label '{/:Bold=14 2  persistent maxima of proximity (III-B)}' at screen 0.01, screen 0.97442 left
set label title at screen 0.99, screen 0.97442 right noenhanced tc rgb '#666666'
set object 1 rectangle from graph 0,0 to graph 1,1 fc rgb '#E9E9E9' fs solid noborder behind
set xrange [-0.5:869.5]
set yrange [-0.5:15.5]
set xtics ('180' -0.5, '135' 108.25, '90' 217, '45' 325.75, '0' 434.5, '-45' 543.25, '-90' 652, '-135' 760.75, '-180' 869.5)
set ylabel 'elevation [deg]' offset 1,0
set ytics ('-15' 0, '-9' 3, '-3' 6, '3' 9, '9' 12, '15' 15)
set xlabel 'azimuth [deg], 0 straight ahead, left of the sensor on the left'
set palette defined (0 '#440154', 1 '#472D7B', 2 '#3B528B', 3 '#2C728E', 4 '#21918C', 5 '#28AE80', 6 '#5EC962', 7 '#ADDC30', 8 '#FDE725')
set cbrange [0:48]
set cbtics 10
set cblabel 'depth [m]'
set colorbox user origin screen 0.9225, screen 0.68605 size screen 0.013333, screen 0.24419 noborder
plot $repaired matrix with image notitle, $maxima using 1:2 with points pt 7 ps 0.75 lc rgb 'black' notitle, $maxima using 1:2 with points pt 7 ps 0.45 lc rgb 'white' notitle
reset
set border lc rgb '#333333'
set tics nomirror out scale 0.5
unset key
set lmargin at screen 0.07
set rmargin at screen 0.9125
set bmargin at screen 0.069767
set tmargin at screen 0.55814
set label '{/:Bold 1 maximum from birth to death}' at screen 0.07, screen 0.57442 left
set xrange [20:0]
set yrange [2:0]
unset ytics
set xlabel 'proximity [m]: the radius of the zone minus the depth'
plot $bars using 2:1:($3 - $2):(0) with vectors nohead lw 6 lc rgb '#3B528B'
unset multiplot
unset output
set terminal pngcairo size 1200,660 font 'sans,12' background '#FFFFFF'
set output '3_merged.png'
set multiplot
reset
set border lc rgb '#333333'
set tics nomirror out scale 0.5
unset key
set lmargin at screen 0.07
set rmargin at screen 0.9125
set bmargin at screen 0.59091
set tmargin at screen 0.90909
set label '{/:Bold=14 3  maxima sharpened and merged (III-B)}' at screen 0.01, screen 0.96667 left
set label title at screen 0.99, screen 0.96667 right noenhanced tc rgb '#666666'
set object 1 rectangle from graph 0,0 to graph 1,1 fc rgb '#E9E9E9' fs solid noborder behind
set xrange [-0.5:869.5]
set yrange [-0.5:15.5]
set xtics ('180' -0.5, '135' 108.25, '90' 217, '45' 325.75, '0' 434.5, '-45' 543.25, '-90' 652, '-135' 760.75, '-180' 869.5)
set ylabel 'elevation [deg]' offset 1,0
set ytics ('-15' 0, '-9' 3, '-3' 6, '3' 9, '9' 12, '15' 15)
set xlabel 'azimuth [deg], 0 straight ahead, left of the sensor on the left'
set palette defined (0 '#440154', 1 '#472D7B', 2 '#3B528B', 3 '#2C728E', 4 '#21918C', 5 '#28AE80', 6 '#5EC962', 7 '#ADDC30', 8 '#FDE725')
set cbrange [0:48]
set cbtics 10
set cblabel 'depth [m]'
set colorbox user origin screen 0.9225, screen 0.59091 size screen 0.013333, screen 0.31818 noborder
plot $merged matrix with image notitle
reset
set border lc rgb '#333333'
set tics nomirror out scale 0.5
unset key
set lmargin at screen 0.07
set rmargin at screen 0.475
set bmargin at screen 0.090909
set tmargin at screen 0.40909
set label '{/:Bold around the column at 23.8 deg, before}' at screen 0.07, screen 0.4303 left
set object 1 rectangle from graph 0,0 to graph 1,1 fc rgb '#E9E9E9' fs solid noborder behind
set xrange [304.5:449.5]
set yrange [-0.5:15.5]
set xtics ('50' 313.67, '40' 337.83, '30' 362, '20' 386.17, '10' 410.33, '0' 434.5)
set ylabel 'elevation [deg]' offset 1,0
set ytics ('-15' 0, '-9' 3, '-3' 6, '3' 9, '9' 12, '15' 15)
set xlabel 'azimuth [deg], 0 straight ahead, left of the sensor on the left'
set xlabel 'azimuth [deg]'
set palette defined (0 '#440154', 1 '#472D7B', 2 '#3B528B', 3 '#2C728E', 4 '#21918C', 5 '#28AE80', 6 '#5EC962', 7 '#ADDC30', 8 '#FDE725')
set cbrange [0:48]
set cbtics 10
set cblabel 'depth [m]'
set colorbox user origin screen 0.485, screen 0.090909 size screen 0.013333, screen 0.31818 noborder
unset colorbox
plot $repaired matrix with image notitle
reset
set border lc rgb '#333333'
set tics nomirror out scale 0.5
unset key
set lmargin at screen 0.54167
set rmargin at screen 0.95
set bmargin at screen 0.090909
set tmargin at screen 0.40909
set label '{/:Bold after}' at screen 0.54167, screen 0.4303 left
set object 1 rectangle from graph 0,0 to graph 1,1 fc rgb '#E9E9E9' fs solid noborder behind
set xrange [304.5:449.5]
set yrange [-0.5:15.5]
set xtics ('50' 313.67, '40' 337.83, '30' 362, '20' 386.17, '10' 410.33, '0' 434.5)
set ylabel 'elevation [deg]' offset 1,0
set ytics ('-15' 0, '-9' 3, '-3' 6, '3' 9, '9' 12, '15' 15)
set xlabel 'azimuth [deg], 0 straight ahead, left of the sensor on the left'
set xlabel 'azimuth [deg]'
set palette defined (0 '#440154', 1 '#472D7B', 2 '#3B528B', 3 '#2C728E', 4 '#21918C', 5 '#28AE80', 6 '#5EC962', 7 '#ADDC30', 8 '#FDE725')
set cbrange [0:48]
set cbtics 10
set cblabel 'depth [m]'
set colorbox user origin screen 0.96, screen 0.090909 size screen 0.013333, screen 0.31818 noborder
unset colorbox
plot $merged matrix with image notitle
unset multiplot
unset output
set terminal pngcairo size 1200,330 font 'sans,12' background '#FFFFFF'
set output '4_range_angle.png'
set multiplot
reset
set border lc rgb '#333333'
set tics nomirror out scale 0.5
unset key
set lmargin at screen 0.07
set rmargin at screen 0.9125
set bmargin at screen 0.18182
set tmargin at screen 0.81818
set label '{/:Bold=14 4  range angle image (III-C)}' at screen 0.01, screen 0.93333 left
set label title at screen 0.99, screen 0.93333 right noenhanced tc rgb '#666666'
set object 1 rectangle from graph 0,0 to graph 1,1 fc rgb '#E9E9E9' fs solid noborder behind
set xrange [-0.5:869.5]
set yrange [-1:15]
set xtics ('180' -0.5, '135' 108.25, '90' 217, '45' 325.75, '0' 434.5, '-45' 543.25, '-90' 652, '-135' 760.75, '-180' 869.5)
set ylabel 'elevation [deg]' offset 1,0
set ytics ('-15' -0.5, '-9' 2.5, '-3' 5.5, '3' 8.5, '9' 11.5, '15' 14.5)
set xlabel 'azimuth [deg], 0 straight ahead, left of the sensor on the left'
set palette defined (0 '#00224E', 1 '#123570', 2 '#3B496C', 3 '#575D6D', 4 '#707173', 5 '#8A8678', 6 '#A59C74', 7 '#C3B369', 8 '#E1CC55', 9 '#FEE838')
set cbrange [0:90]
set cbtics 30
set cblabel 'angle [deg]'
set colorbox user origin screen 0.9225, screen 0.18182 size screen 0.013333, screen 0.63636 noborder
plot $angle matrix with image notitle
unset multiplot
unset output
set terminal pngcairo size 1200,860 font 'sans,12' background '#FFFFFF'
set output '5_smoothed.png'
set multiplot
reset
set border lc rgb '#333333'
set tics nomirror out scale 0.5
unset key
set lmargin at screen 0.07
set rmargin at screen 0.9125
set bmargin at screen 0.68605
set tmargin at screen 0.93023
set label '{/:Bold=14 5  singular spectrum analysis (III-D)}' at screen 0.01, screen 0.97442 left
set label title at screen 0.99, screen 0.97442 right noenhanced tc rgb '#666666'
set object 1 rectangle from graph 0,0 to graph 1,1 fc rgb '#E9E9E9' fs solid noborder behind
set xrange [-0.5:869.5]
set yrange [-1:15]
set xtics ('180' -0.5, '135' 108.25, '90' 217, '45' 325.75, '0' 434.5, '-45' 543.25, '-90' 652, '-135' 760.75, '-180' 869.5)
set ylabel 'elevation [deg]' offset 1,0
set ytics ('-15' -0.5, '-9' 2.5, '-3' 5.5, '3' 8.5, '9' 11.5, '15' 14.5)
set xlabel 'azimuth [deg], 0 straight ahead, left of the sensor on the left'
set palette defined (0 '#00224E', 1 '#123570', 2 '#3B496C', 3 '#575D6D', 4 '#707173', 5 '#8A8678', 6 '#A59C74', 7 '#C3B369', 8 '#E1CC55', 9 '#FEE838')
set cbrange [0:90]
set cbtics 30
set cblabel 'angle [deg]'
set colorbox user origin screen 0.9225, screen 0.68605 size screen 0.013333, screen 0.24419 noborder
set arrow from 377, screen 0.95581 to 377, screen 0.93023 filled size screen 0.007,25 lw 2 lc rgb '#D55E00' front
plot $smoothed matrix with image notitle
reset
set border lc rgb '#333333'
set tics nomirror out scale 0.5
unset key
set lmargin at screen 0.07
set rmargin at screen 0.46667
set bmargin at screen 0.069767
set tmargin at screen 0.53488
set label '{/:Bold the column at 23.8 deg}' at screen 0.07, screen 0.55116 left
set xrange [-0.5:15.5]
set yrange [-5:95]
set ytics 30
set xlabel 'elevation [deg]'
set ylabel 'range angle [deg]'
set grid ytics lc rgb '#DDDDDD' lt 1
set key at graph 1, graph 1.01 right bottom horizontal samplen 1.5
set xtics ('-15' 0, '-9' 3, '-3' 6, '3' 9, '9' 12, '15' 15)
plot $before using 1:2 with linespoints pt 6 ps 1 lw 1.5 lc rgb '#888888' title 'before', $after using 1:2 with linespoints pt 7 ps 0.8 lw 2 lc rgb '#0072B2' title 'after'
reset
set border lc rgb '#333333'
set tics nomirror out scale 0.5
unset key
set lmargin at screen 0.63333
set rmargin at screen 0.975
set bmargin at screen 0.069767
set tmargin at screen 0.53488
set label '{/:Bold principal components, 5 of 8 kept (blue)}' at screen 0.63333, screen 0.55116 left
set xrange [-0.5:15.5]
set yrange [-7.6:0.6]
set xlabel 'elevation [deg]'
set ylabel 'component: its fraction of variance'
set xtics ('-15' 0, '-9' 3, '-3' 6, '3' 9, '9' 12, '15' 15)
set ytics ('1:  97.1 %%' 0, '2:  2.4 %%' -1, '3:  0.4 %%' -2, '4:  < 0.1 %%' -3, '5:  < 0.1 %%' -4, '6:  < 0.1 %%' -5, '7:  < 0.1 %%' -6, '8:  < 0.1 %%' -7)
set grid ytics lc rgb '#DDDDDD' lt 1
plot for [c=0:4] $elementary index c using 1:2 with lines lw 2 lc rgb '#0072B2' notitle, for [c=5:7] $elementary index c using 1:2 with lines lw 2 dt (4,3) lc rgb '#888888' notitle
unset multiplot
unset output
set terminal pngcairo size 1200,660 font 'sans,12' background '#FFFFFF'
set output '6_labels.png'
set multiplot
reset
set border lc rgb '#333333'
set tics nomirror out scale 0.5
unset key
set lmargin at screen 0.07
set rmargin at screen 0.9125
set bmargin at screen 0.59091
set tmargin at screen 0.87879
set label '{/:Bold=14 6  regions of interest (III-E)}' at screen 0.01, screen 0.96667 left
set label title at screen 0.99, screen 0.96667 right noenhanced tc rgb '#666666'
set object 1 rectangle from graph 0,0 to graph 1,1 fc rgb '#E9E9E9' fs solid noborder behind
set xrange [-0.5:869.5]
set yrange [-0.5:15.5]
set xtics ('180' -0.5, '135' 108.25, '90' 217, '45' 325.75, '0' 434.5, '-45' 543.25, '-90' 652, '-135' 760.75, '-180' 869.5)
set ylabel 'elevation [deg]' offset 1,0
set ytics ('-15' 0, '-9' 3, '-3' 6, '3' 9, '9' 12, '15' 15)
set xlabel 'azimuth [deg], 0 straight ahead, left of the sensor on the left'
set palette maxcolors 7 defined (0 '#A9BCCB', 1 '#D55E00', 2 '#0072B2', 3 '#009E73', 4 '#CC79A7', 5 '#E69F00', 6 '#7A1F5C')
set cbrange [0:6]
unset colorbox
set label '' at screen 0.44583, screen 0.9 left point pt 5 ps 1.5 lc rgb '#D55E00' offset 0,0
set label '' at screen 0.4575, screen 0.9 left point pt 5 ps 1.5 lc rgb '#0072B2' offset 0,0
set label '' at screen 0.46917, screen 0.9 left point pt 5 ps 1.5 lc rgb '#009E73' offset 0,0
set label '' at screen 0.48083, screen 0.9 left point pt 5 ps 1.5 lc rgb '#CC79A7' offset 0,0
set label '' at screen 0.4925, screen 0.9 left point pt 5 ps 1.5 lc rgb '#E69F00' offset 0,0
set label 'RoI, one colour per obstacle' at screen 0.50417, screen 0.9 left point pt 5 ps 1.5 lc rgb '#7A1F5C' offset 1,0
set label 'ROU: ground, far' at screen 0.7255, screen 0.9 left point pt 5 ps 1.5 lc rgb '#A9BCCB' offset 1,0
set label 'no return' at screen 0.86483, screen 0.9 left point pt 5 ps 1.5 lc rgb '#E9E9E9' offset 1,0
plot $labels matrix with image notitle
reset
set border lc rgb '#333333'
set tics nomirror out scale 0.5
unset key
set lmargin at screen 0.07
set rmargin at screen 0.9125
set bmargin at screen 0.090909
set tmargin at screen 0.40909
set label '{/:Bold around the column at 23.8 deg}' at screen 0.07, screen 0.4303 left
set object 1 rectangle from graph 0,0 to graph 1,1 fc rgb '#E9E9E9' fs solid noborder behind
set xrange [304.5:449.5]
set yrange [-0.5:15.5]
set xtics ('50' 313.67, '40' 337.83, '30' 362, '20' 386.17, '10' 410.33, '0' 434.5)
set ylabel 'elevation [deg]' offset 1,0
set ytics ('-15' 0, '-9' 3, '-3' 6, '3' 9, '9' 12, '15' 15)
set xlabel 'azimuth [deg], 0 straight ahead, left of the sensor on the left'
set xlabel 'azimuth [deg]'
set palette maxcolors 7 defined (0 '#A9BCCB', 1 '#D55E00', 2 '#0072B2', 3 '#009E73', 4 '#CC79A7', 5 '#E69F00', 6 '#7A1F5C')
set cbrange [0:6]
unset colorbox
plot $labels matrix with image notitle
unset multiplot
unset output
set terminal pngcairo size 900,960 font 'sans,12' background '#FFFFFF'
set output '7_top_view.png'
set multiplot
reset
set border lc rgb '#333333'
set tics nomirror out scale 0.5
unset key
set lmargin at screen 0.077778
set rmargin at screen 0.97778
set bmargin at screen 0.0625
set tmargin at screen 0.90625
set label '{/:Bold=14 7  the returns from above}' at screen 0.013333, screen 0.97708 left
set label title at screen 0.98667, screen 0.97708 right noenhanced tc rgb '#666666'
set label '' at screen 0.086667, screen 0.92083 left point pt 5 ps 1.5 lc rgb '#D55E00' offset 0,0
set label '' at screen 0.10222, screen 0.92083 left point pt 5 ps 1.5 lc rgb '#0072B2' offset 0,0
set label '' at screen 0.11778, screen 0.92083 left point pt 5 ps 1.5 lc rgb '#009E73' offset 0,0
set label '' at screen 0.13333, screen 0.92083 left point pt 5 ps 1.5 lc rgb '#CC79A7' offset 0,0
set label '' at screen 0.14889, screen 0.92083 left point pt 5 ps 1.5 lc rgb '#E69F00' offset 0,0
set label 'RoI, one colour per obstacle' at screen 0.16444, screen 0.92083 left point pt 5 ps 1.5 lc rgb '#7A1F5C' offset 1,0
set label 'ROU: ground, far' at screen 0.45956, screen 0.92083 left point pt 5 ps 1.5 lc rgb '#A9BCCB' offset 1,0
set xrange [23:-23]
set yrange [-23:23]
set xlabel 'y, to the left [m]'
set ylabel 'x, forward [m]' offset 1,0
set grid lc rgb '#EEEEEE' lt 1
set object 1 circle at 0,0 size 20 fs empty border lc rgb '#888888' dt 2
plot $rou using 2:1 with points pt 7 ps 0.25 lc rgb '#A9BCCB' notitle, $roi using 2:1:3 with points pt 7 ps 0.4 lc rgb variable notitle, $unclassified using 2:1 with points pt 2 ps 0.5 lc rgb '#333333' notitle, '+' every ::::0 using (0):(0) with points pt 2 ps 2 lw 3 lc rgb 'black' notitle
unset multiplot
unset output
set terminal pngcairo size 1200,1540 font 'sans,12' background '#FFFFFF'
set output 'stages.png'
set multiplot
reset
set border lc rgb '#333333'
set tics nomirror out scale 0.5
unset key
set lmargin at screen 0.07
set rmargin at screen 0.9125
set bmargin at screen 0.89481
set tmargin at screen 0.95844
set label '{/:Bold=14 Stages of the segmentation}' at screen 0.01, screen 0.98571 left
set label title at screen 0.99, screen 0.98571 right noenhanced tc rgb '#666666'
set label '{/:Bold 1  depth image (III-A)}' at screen 0.07, screen 0.96753 left
set object 1 rectangle from graph 0,0 to graph 1,1 fc rgb '#E9E9E9' fs solid noborder behind
set xrange [-0.5:869.5]
set yrange [-0.5:15.5]
set xtics ('' -0.5, '' 108.25, '' 217, '' 325.75, '' 434.5, '' 543.25, '' 652, '' 760.75, '' 869.5)
set ylabel 'elevation [deg]' offset 1,0
set ytics ('-15' 0, '-5' 5, '5' 10, '15' 15)
set palette defined (0 '#440154', 1 '#472D7B', 2 '#3B528B', 3 '#2C728E', 4 '#21918C', 5 '#28AE80', 6 '#5EC962', 7 '#ADDC30', 8 '#FDE725')
set cbrange [0:48]
set cbtics 10
set cblabel 'depth [m]'
set colorbox user origin screen 0.9225, screen 0.89481 size screen 0.013333, screen 0.063636 noborder
plot $depth matrix with image notitle
reset
set border lc rgb '#333333'
set tics nomirror out scale 0.5
unset key
set lmargin at screen 0.07
set rmargin at screen 0.9125
set bmargin at screen 0.80779
set tmargin at screen 0.87143
set label '{/:Bold 2  persistent maxima of proximity (III-B)}' at screen 0.07, screen 0.88052 left
set object 1 rectangle from graph 0,0 to graph 1,1 fc rgb '#E9E9E9' fs solid noborder behind
set xrange [-0.5:869.5]
set yrange [-0.5:15.5]
set xtics ('' -0.5, '' 108.25, '' 217, '' 325.75, '' 434.5, '' 543.25, '' 652, '' 760.75, '' 869.5)
set ylabel 'elevation [deg]' offset 1,0
set ytics ('-15' 0, '-5' 5, '5' 10, '15' 15)
set palette defined (0 '#440154', 1 '#472D7B', 2 '#3B528B', 3 '#2C728E', 4 '#21918C', 5 '#28AE80', 6 '#5EC962', 7 '#ADDC30', 8 '#FDE725')
set cbrange [0:48]
set cbtics 10
set cblabel 'depth [m]'
set colorbox user origin screen 0.9225, screen 0.80779 size screen 0.013333, screen 0.063636 noborder
plot $repaired matrix with image notitle, $maxima using 1:2 with points pt 7 ps 0.75 lc rgb 'black' notitle, $maxima using 1:2 with points pt 7 ps 0.45 lc rgb 'white' notitle
reset
set border lc rgb '#333333'
set tics nomirror out scale 0.5
unset key
set lmargin at screen 0.07
set rmargin at screen 0.9125
set bmargin at screen 0.72078
set tmargin at screen 0.78442
set label '{/:Bold 3  maxima sharpened and merged (III-B)}' at screen 0.07, screen 0.79351 left
set object 1 rectangle from graph 0,0 to graph 1,1 fc rgb '#E9E9E9' fs solid noborder behind
set xrange [-0.5:869.5]
set yrange [-0.5:15.5]
set xtics ('' -0.5, '' 108.25, '' 217, '' 325.75, '' 434.5, '' 543.25, '' 652, '' 760.75, '' 869.5)
set ylabel 'elevation [deg]' offset 1,0
set ytics ('-15' 0, '-5' 5, '5' 10, '15' 15)
set palette defined (0 '#440154', 1 '#472D7B', 2 '#3B528B', 3 '#2C728E', 4 '#21918C', 5 '#28AE80', 6 '#5EC962', 7 '#ADDC30', 8 '#FDE725')
set cbrange [0:48]
set cbtics 10
set cblabel 'depth [m]'
set colorbox user origin screen 0.9225, screen 0.72078 size screen 0.013333, screen 0.063636 noborder
plot $merged matrix with image notitle
reset
set border lc rgb '#333333'
set tics nomirror out scale 0.5
unset key
set lmargin at screen 0.07
set rmargin at screen 0.9125
set bmargin at screen 0.63377
set tmargin at screen 0.6974
set label '{/:Bold 4  range angle image (III-C)}' at screen 0.07, screen 0.70649 left
set object 1 rectangle from graph 0,0 to graph 1,1 fc rgb '#E9E9E9' fs solid noborder behind
set xrange [-0.5:869.5]
set yrange [-1:15]
set xtics ('' -0.5, '' 108.25, '' 217, '' 325.75, '' 434.5, '' 543.25, '' 652, '' 760.75, '' 869.5)
set ylabel 'elevation [deg]' offset 1,0
set ytics ('-15' -0.5, '-5' 4.5, '5' 9.5, '15' 14.5)
set palette defined (0 '#00224E', 1 '#123570', 2 '#3B496C', 3 '#575D6D', 4 '#707173', 5 '#8A8678', 6 '#A59C74', 7 '#C3B369', 8 '#E1CC55', 9 '#FEE838')
set cbrange [0:90]
set cbtics 30
set cblabel 'angle [deg]'
set colorbox user origin screen 0.9225, screen 0.63377 size screen 0.013333, screen 0.063636 noborder
plot $angle matrix with image notitle
reset
set border lc rgb '#333333'
set tics nomirror out scale 0.5
unset key
set lmargin at screen 0.07
set rmargin at screen 0.9125
set bmargin at screen 0.54675
set tmargin at screen 0.61039
set label '{/:Bold 5  smoothed by singular spectrum analysis (III-D)}' at screen 0.07, screen 0.61948 left
set object 1 rectangle from graph 0,0 to graph 1,1 fc rgb '#E9E9E9' fs solid noborder behind
set xrange [-0.5:869.5]
set yrange [-1:15]
set xtics ('' -0.5, '' 108.25, '' 217, '' 325.75, '' 434.5, '' 543.25, '' 652, '' 760.75, '' 869.5)
set ylabel 'elevation [deg]' offset 1,0
set ytics ('-15' -0.5, '-5' 4.5, '5' 9.5, '15' 14.5)
set palette defined (0 '#00224E', 1 '#123570', 2 '#3B496C', 3 '#575D6D', 4 '#707173', 5 '#8A8678', 6 '#A59C74', 7 '#C3B369', 8 '#E1CC55', 9 '#FEE838')
set cbrange [0:90]
set cbtics 30
set cblabel 'angle [deg]'
set colorbox user origin screen 0.9225, screen 0.54675 size screen 0.013333, screen 0.063636 noborder
set arrow from 377, screen 0.53896 to 377, screen 0.54675 filled size screen 0.007,25 lw 2 lc rgb '#D55E00' front
plot $smoothed matrix with image notitle
reset
set border lc rgb '#333333'
set tics nomirror out scale 0.5
unset key
set lmargin at screen 0.07
set rmargin at screen 0.9125
set bmargin at screen 0.45974
set tmargin at screen 0.52338
set label '{/:Bold 6  regions of interest (III-E)}' at screen 0.07, screen 0.53247 left
set object 1 rectangle from graph 0,0 to graph 1,1 fc rgb '#E9E9E9' fs solid noborder behind
set xrange [-0.5:869.5]
set yrange [-0.5:15.5]
set xtics ('180' -0.5, '135' 108.25, '90' 217, '45' 325.75, '0' 434.5, '-45' 543.25, '-90' 652, '-135' 760.75, '-180' 869.5)
set ylabel 'elevation [deg]' offset 1,0
set ytics ('-15' 0, '-5' 5, '5' 10, '15' 15)
set xlabel 'azimuth [deg], 0 straight ahead, left of the sensor on the left'
set palette maxcolors 7 defined (0 '#A9BCCB', 1 '#D55E00', 2 '#0072B2', 3 '#009E73', 4 '#CC79A7', 5 '#E69F00', 6 '#7A1F5C')
set cbrange [0:6]
unset colorbox
set label '' at screen 0.44583, screen 0.53247 left point pt 5 ps 1.5 lc rgb '#D55E00' offset 0,0
set label '' at screen 0.4575, screen 0.53247 left point pt 5 ps 1.5 lc rgb '#0072B2' offset 0,0
set label '' at screen 0.46917, screen 0.53247 left point pt 5 ps 1.5 lc rgb '#009E73' offset 0,0
set label '' at screen 0.48083, screen 0.53247 left point pt 5 ps 1.5 lc rgb '#CC79A7' offset 0,0
set label '' at screen 0.4925, screen 0.53247 left point pt 5 ps 1.5 lc rgb '#E69F00' offset 0,0
set label 'RoI, one colour per obstacle' at screen 0.50417, screen 0.53247 left point pt 5 ps 1.5 lc rgb '#7A1F5C' offset 1,0
set label 'ROU: ground, far' at screen 0.7255, screen 0.53247 left point pt 5 ps 1.5 lc rgb '#A9BCCB' offset 1,0
set label 'no return' at screen 0.86483, screen 0.53247 left point pt 5 ps 1.5 lc rgb '#E9E9E9' offset 1,0
plot $labels matrix with image notitle
reset
set border lc rgb '#333333'
set tics nomirror out scale 0.5
unset key
set lmargin at screen 0.07
set rmargin at screen 0.45
set bmargin at screen 0.25325
set tmargin at screen 0.38961
set label '{/:Bold 2  1 maximum from birth to death}' at screen 0.07, screen 0.3987 left
set xrange [20:0]
set yrange [2:0]
unset ytics
set xlabel 'proximity [m]: the radius of the zone minus the depth'
plot $bars using 2:1:($3 - $2):(0) with vectors nohead lw 6 lc rgb '#3B528B'
reset
set border lc rgb '#333333'
set tics nomirror out scale 0.5
unset key
set lmargin at screen 0.125
set rmargin at screen 0.45
set bmargin at screen 0.038961
set tmargin at screen 0.18831
set label '{/:Bold 5  principal components, 5 of 8 kept (blue)}' at screen 0.125, screen 0.1974 left
set xrange [-0.5:15.5]
set yrange [-7.6:0.6]
set xlabel 'elevation [deg]'
set ylabel 'component: its fraction of variance'
set xtics ('-15' 0, '-9' 3, '-3' 6, '3' 9, '9' 12, '15' 15)
set ytics ('1:  97.1 %%' 0, '2:  2.4 %%' -1, '3:  0.4 %%' -2, '4:  < 0.1 %%' -3, '5:  < 0.1 %%' -4, '6:  < 0.1 %%' -5, '7:  < 0.1 %%' -6, '8:  < 0.1 %%' -7)
set grid ytics lc rgb '#DDDDDD' lt 1
plot for [c=0:4] $elementary index c using 1:2 with lines lw 2 lc rgb '#0072B2' notitle, for [c=5:7] $elementary index c using 1:2 with lines lw 2 dt (4,3) lc rgb '#888888' notitle
reset
set border lc rgb '#333333'
set tics nomirror out scale 0.5
unset key
set lmargin at screen 0.53333
set rmargin at screen 0.98333
set bmargin at screen 0.038961
set tmargin at screen 0.38961
set label '{/:Bold 7  the returns from above}' at screen 0.53333, screen 0.3987 left
set xrange [23:-23]
set yrange [-23:23]
set xlabel 'y, to the left [m]'
set ylabel 'x, forward [m]' offset 1,0
set grid lc rgb '#EEEEEE' lt 1
set object 1 circle at 0,0 size 20 fs empty border lc rgb '#888888' dt 2
plot $rou using 2:1 with points pt 7 ps 0.25 lc rgb '#A9BCCB' notitle, $roi using 2:1:3 with points pt 7 ps 0.4 lc rgb variable notitle, $unclassified using 2:1 with points pt 2 ps 0.5 lc rgb '#333333' notitle, '+' every ::::0 using (0):(0) with points pt 2 ps 2 lw 3 lc rgb 'black' notitle
unset multiplot
unset output
