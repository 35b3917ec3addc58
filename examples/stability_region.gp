# SPDX-License-Identifier: BSD-3-Clause
# Fig. 1: the predicted triangle and what a pendulum did. Run in the folder of stability_region.dat.
set terminal pngcairo size 800,800 font "Sans,12"
set output "stability_region.png"
data = "stability_region.dat"
set title "Stability region of explicit Euler" font "Sans,14"
set xlabel "{/Symbol a} h"
set ylabel "{/Symbol b}^2 h^2"
set xrange [0:2.2]
set yrange [0:4.5]
set key below samplen 2
set object 1 polygon from 0,0 to 1,0 to 2,4 to 0,0 fillstyle empty border lc rgb "#000000" lw 2
set style textbox opaque noborder
set label 1 "Taylor (10, 11)" at 0.95,2.1 right front boxed
set label 2 "dead-beat" at 0.96,1.0 right front boxed
plot data index "points" using ($4 == 1 ? $1 : NaN):2 with points pt 7 ps 0.7 lc rgb "#0b5fa5" \
       title "pendulum: violation decays", \
     data index "points" using ($4 == 0 ? $1 : NaN):2 with points pt 7 ps 0.3 lc rgb "#d9a27a" \
       title "violation grows", \
     data index "points" using ($3 != $4 ? $1 : NaN):2 with points pt 6 ps 1.6 lw 2 lc rgb "#c92a2a" \
       title "not as predicted", \
     NaN with lines lc rgb "#000000" lw 2 title "predicted region (19)", \
     "-" with points pt 2 ps 1.6 lw 2.5 lc rgb "#000000" notitle
1 2
1 1
e
