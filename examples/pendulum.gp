# SPDX-License-Identifier: BSD-3-Clause
# Plots the motion of the pendulum, and its error. Run it in the folder of pendulum.dat.
set terminal pngcairo size 1000,760 font "Sans,11"
set output "pendulum.png"
data = "pendulum.dat"
set multiplot layout 2,1 title "Pendulum by one function: 1 kg on 1 m, CVODE Adams, rtol 10^{-9}" font "Sans,13"
set xlabel "t [s]"
set xrange [0:10]
set grid lw 0.5 lc rgb "#cccccc"
set lmargin 11

set title "positions"
set ylabel "[m]"
set yrange [-1.1:1.6]
set ytics 0.5
set key top right horizontal
plot data index "path" using 1:2 with lines lw 1.5 lc rgb "#0b5fa5" title "x", \
     data index "path" using 1:3 with lines lw 1.5 lc rgb "#d1700b" title "y"

set title "errors"
set ylabel "[m], [m^2], [J]"
set logscale y
set format y "10^{%L}"
set yrange [1e-10:1e-5]
set ytics auto
plot data index "path" using 1:4 with lines lc rgb "#0b5fa5" title "error of position [m]", \
     data index "path" using 1:(abs($5)) with lines lc rgb "#d1700b" title "energy change [J]", \
     data index "motion" using 1:5 with lines lw 1.5 lc rgb "#2b8a3e" title "max|{/Symbol F}| so far [m^2]"
unset multiplot
