# SPDX-License-Identifier: BSD-3-Clause
# Plots Fig. 1 of the paper for every fixed-step integrator: the predicted region with contours of
# the spectral radius, and the observed behaviour of a slider-crank. Run it in the folder of
# stability_region.dat.
set terminal pngcairo size 1900,860 font "Sans,11"
set output "stability_region.png"
data = "stability_region.dat"
set datafile missing "NaN"
names = "euler semi_implicit_euler rk2 rk3 rk4 dp5 rk8 ab2 ab3 ab4"
titles = "'explicit Euler' 'semi-implicit Euler' RK2 RK3 RK4 'DP5' 'RK8' AB2 AB3 AB4"
radii = "1 0.9 0.75 0.5 0.25"
colour(l) = word("#000000 #1c4e80 #2f7fb8 #5fb0d3 #9ad3e3", l)
width(l) = l == 1 ? 2.2 : 1.4
set grid lw 0.5 lc rgb "#e6e6e6"
set tics nomirror
set border 3
set xlabel "{/Symbol a} h" offset 0,0.6
set ylabel "{/Symbol b}^2 h^2" offset 1.2,0
set xrange [0:*]
set yrange [0:*]
set bmargin 3.6
set multiplot layout 2,5 margins 0.04,0.99,0.13,0.91 spacing 0.042,0.12 \
    title "Where gains keep the constraints: level lines of the spectral radius, and a slider-crank with 22 x 22 pairs of gains" \
    font "Sans,14"
do for [k=1:10] {
  name = word(names, k)
  set title word(titles, k) font "Sans,12" offset 0,-0.6
  if (k == 10) { set key at screen 0.5,0.03 center center maxrows 1 samplen 2 width 1 } else { unset key }
  # The key consists of separate keyentry elements. Otherwise a kind of points that does not occur
  # in the last plot would be missing in the key.
  plot data index name."_points" using ($4 == 0 ? $1 : NaN):2 with points pt 7 ps 0.25 \
         lc rgb "#d9a27a" notitle, \
       data index name."_points" using ($4 == 1 ? $1 : NaN):2 with points pt 7 ps 0.55 \
         lc rgb "#c2cbd3" notitle, \
       for [l=1:5] data index name."_outline" using ($1 == real(word(radii, l)) ? $2 : NaN):3 \
         with lines lw width(l) lc rgb colour(l) notitle, \
       data index name."_points" using ($3 != $4 ? $1 : NaN):2 with points pt 6 ps 1.1 lw 1.5 \
         lc rgb "#c92a2a" notitle, \
       data index "methods" using (strcol(1) eq name ? $3 : NaN):4 with points pt 2 ps 1.2 lw 2 \
         lc rgb "#c2255c" notitle, \
       for [l=1:5] keyentry with lines lw width(l) lc rgb colour(l) title "radius ".word(radii, l), \
       keyentry with points pt 2 ps 1.2 lw 2 lc rgb "#c2255c" title "least radius", \
       keyentry with points pt 7 ps 0.8 lc rgb "#c2cbd3" title "violation decays", \
       keyentry with points pt 7 ps 0.4 lc rgb "#d9a27a" title "violation grows", \
       keyentry with points pt 6 ps 1.1 lw 1.5 lc rgb "#c92a2a" title "not as predicted"
}
unset multiplot
