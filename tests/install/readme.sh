#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# usage: readme.sh
# Must be run as root on a bare Debian, in the top folder of the project. Runs the commands for installing in README.md
# and docs/install.md exactly as they are printed there. They install the C library in /usr/local and then in the home
# directory, Python from the sources, and the Debian packages, in this order.
set -eu
. tests/install/documented.sh

# The first programs of the README in C and in Python, and what the program in C prints.
first_block README.md c >program.c
first_block README.md text >expected.txt
first_block README.md python >program.py

run_program() {
  ./program >printed.txt
  diff expected.txt printed.txt
  ldd program | grep baum
}

echo "==== the C library"
follow README.md Install 2
run_program

echo "==== without root"
xargs rm <build/mine/install_manifest.txt
ldconfig
follow docs/install.md "The C library" 2
(
  eval "$(documented docs/install.md "The C library" 3)"
  # shellcheck disable=SC2046
  cc program.c $(pkg-config --cflags --libs baum) -lm -o program
  run_program
)

echo "==== Python from the sources"
follow docs/install.md "Python from the sources" 1
env/bin/python program.py

echo "==== Debian packages"
follow docs/install.md "Debian packages" 1
# shellcheck disable=SC2046
cc program.c $(pkg-config --cflags --libs baum) -lm -o program
run_program
python3 program.py
