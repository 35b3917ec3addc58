# SPDX-License-Identifier: BSD-3-Clause
# Plots Fig. 3 of the paper, Phi_3 over time, in four panels. Run it in the folder of
# slider_crank.dat.
set terminal pngcairo size 1200,800 font "Sans,11"
set output "slider_crank.png"
set multiplot layout 2,2 title "Eccentric slider-crank, explicit Euler, h = 10^{-4} s: error of the 3rd constraint" \
  font "Sans,13"
data = "slider_crank.dat"
set xlabel "t [s]"
set grid lw 0.5 lc rgb "#cccccc"
set key top left Left reverse samplen 2 box lc rgb "#cccccc"
set style line 1 lc rgb "#0b5fa5" lw 1.2
set style line 2 lc rgb "#d1700b" lw 1.2
set style line 3 lc rgb "#2b8a3e" lw 1.2

set ylabel "{/Symbol F}_3 [m]"
set title "(a) no stabilization"
plot data index "phi3" using 1:2 with lines ls 1 title "none"

set ylabel "{/Symbol F}_3 [mm]"
set title "(b) equal gains: critical damping"
set yrange [-8:14]
plot data index "phi3" using 1:(1e3 * $3) with lines ls 1 title "{/Symbol a} = {/Symbol b} = 5/s", \
     data index "phi3" using 1:(1e3 * $4) with lines ls 2 title "{/Symbol a} = {/Symbol b} = 50/s", \
     data index "phi3" using 1:(1e3 * $5) with lines ls 3 title "{/Symbol a} = {/Symbol b} = 500/s"

set title "(c) over- and underdamped"
set yrange [-4:6]
plot data index "phi3" using 1:(1e3 * $7) with lines ls 1 title "10 Hz, damping ratio 3", \
     data index "phi3" using 1:(1e3 * $6) with lines ls 2 title "100 Hz, damping ratio 0.2"

set ylabel "{/Symbol F}_3 [{/Symbol m}m]"
set title "(d) gains of size 1/h: a stiff system, the first turn"
set xrange [0:0.042]
set yrange [-35:45]
set xtics 0.01
plot data index "phi3_start" using 1:(1e6 * $8) with lines ls 2 lw 0.6 title "Taylor (10, 11): marginal", \
     data index "phi3_start" using 1:(1e6 * $9) with lines ls 1 title "{/Symbol a} = {/Symbol b} = 1/h"
unset multiplot
