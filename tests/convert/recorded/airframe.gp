$range << EOD
EOD
set encoding utf8
set terminal pngcairo size 1000,560 font 'sans,12' background '#FFFFFF'
set output 'airframe.png'
set title 'a drone' noenhanced
set border lc rgb '#333333'
set tics nomirror out scale 0.5
set xrange [180:-180]
set yrange [-90:90]
set xtics 45
set ytics 30
set grid xtics ytics front lc rgb '#BBBBBB' lt 1
set size ratio -1
set xlabel 'azimuth [deg], 0 straight ahead, left of the sensor on the left'
set ylabel 'elevation [deg]'
set cblabel 'masked up to [m]'
set object 1 rectangle from graph 0,0 to graph 1,1 fc rgb '#E9E9E9' fs solid noborder behind
set cbrange [0:1.2]
set palette defined (0 '#440154', 1 '#3B528B', 2 '#21918C', 3 '#5EC962', 4 '#FDE725')
plot $range matrix using (-180 + 2 * ($1 + 0.5)):(-90 + 2 * ($2 + 0.5)):3 with image pixels notitle
unset output
