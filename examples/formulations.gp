# SPDX-License-Identifier: BSD-3-Clause
# Plots cost over error, and violation over error. Run it in the folder of formulations.dat.
set terminal pngcairo size 1300,620 font "Sans,11"
set output "formulations.png"
data = "formulations.dat"
pairs = "euler baumgarte  euler projection  semi_implicit_euler baumgarte  semi_implicit_euler projection \
rk4 baumgarte  rk4 projection  rk8 baumgarte  rk8 projection  cvode_adams baumgarte  cvode_bdf projection \
ida ggl  ida baumgarte  ida index3"
pair_count = words(pairs) / 2
part(k, i) = word(pairs, 2 * k - 2 + i)
colour(k) = word("#0b5fa5 #0b5fa5 #2b8a3e #2b8a3e #d1700b #d1700b #1098ad #1098ad #862e9c #c2255c #495057 #495057 #000000", k)
mark(k) = int(word("7 6 5 4 9 8 3 1 11 13 14 15 2", k))
set datafile missing "NaN"
set logscale xy
set format x "10^{%L}"
set format y "10^{%L}"
set grid lw 0.5 lc rgb "#dddddd"
set xlabel "largest error of the motion [-]"
set xrange [1e-10:10]
set multiplot layout 1,2 title "Undriven slider-crank, 0.2 s: three settings of each method" font "Sans,13"
set lmargin 11
set rmargin 2
set bmargin 9
unset key
set title "what it costs"
set ylabel "wall time [ms]"
plot for [k=1:pair_count] data index "work" \
     using ((strcol(1) eq part(k, 1)) && (strcol(2) eq part(k, 2)) ? $7 : NaN):4 \
     with linespoints lc rgb colour(k) pt mark(k) lw 1.5 notitle
set title "a small violation is not a small error"
set yrange [1e-17:1e-3]
set ylabel "largest violation |{/Symbol F}| [m]"
set key at screen 0.5,0.02 center bottom maxrows 3 samplen 2 width -6
plot for [k=1:pair_count] data index "work" \
     using ((strcol(1) eq part(k, 1)) && (strcol(2) eq part(k, 2)) ? $7 : NaN):8 \
     with linespoints lc rgb colour(k) pt mark(k) lw 1.5 \
     title part(k, 1)." ".part(k, 2) noenhanced
unset multiplot
