# SPDX-License-Identifier: BSD-3-Clause
# Plots cost over error, and violation over error. Run it in the folder of tradeoff.dat.
set terminal pngcairo size 1300,660 font "Sans,11"
set output "tradeoff.png"
data = "tradeoff.dat"
methods = "'euler baumgarte dead-beat' 'semi_implicit_euler baumgarte dead-beat' 'rk4 baumgarte auto' 'rk4 projection' \
'dp5 projection' 'rk8 projection' 'cvode_adams baumgarte auto' 'cvode_bdf projection' 'ida ggl' 'ida index3'"
colour(k) = word("#0b5fa5 #2b8a3e #d1700b #d1700b #862e9c #c2255c #0e7490 #85600a #495057 #000000", k)
control(k) = word("step step step step rtol rtol rtol rtol rtol rtol", k)
has(k, method, by) = method eq word(methods, k) && by eq control(k)
mark(k) = int(word("7 5 9 8 11 13 15 3 1 2", k))
set datafile missing "NaN"
set logscale xy
set format x "10^{%L}"
set format y "10^{%L}"
set grid lw 0.5 lc rgb "#dddddd"
set xlabel "largest error of the motion [-]"
set xrange [1e-13:10]
set multiplot layout 1,2 title "Undriven slider-crank, 0.2 s: a line is a method, a mark a step or tolerance; dots are all other settings" \
  font "Sans,13"
set lmargin 11
set rmargin 2
set bmargin 10
unset key
set title "what an error costs"
set ylabel "CPU time [ms]"
plot data index "entries" using 2:4 with points pt 7 ps 0.3 lc rgb "#b8c0c8" notitle, \
     for [k=1:10] data index "entries" using (has(k, strcol(7), strcol(8)) ? $2 : NaN):4 \
     with linespoints lc rgb colour(k) pt mark(k) lw 1.5 notitle
set title "a small violation is not a small error"
set yrange [1e-17:1e-1]
set ylabel "largest violation |{/Symbol F}| [m]"
set key at screen 0.5,0.02 center bottom maxrows 4 samplen 2 width -8
plot data index "entries" using 2:5 with points pt 7 ps 0.3 lc rgb "#b8c0c8" notitle, \
     for [k=1:10] data index "entries" using (has(k, strcol(7), strcol(8)) ? $2 : NaN):5 \
     with linespoints lc rgb colour(k) pt mark(k) lw 1.5 title word(methods, k) noenhanced
unset multiplot
