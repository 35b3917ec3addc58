#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# usage: sh docs/build.sh
#
# Installs missing packages and builds the documentation site. Its first page is build/site/index.html, and every
# browser can open it from there. The build itself uses no network.
# BAUM_LIBRARY names the libbaum.so that makes the pictures and pages; libbaum_catalog.so must be beside it. Without
# BAUM_LIBRARY, the script builds both.
set -eu
cd "$(dirname "$0")/.."
. tests/setup.sh

need_packages doxygen gcc libc6-dev python3 python3-venv
venv=build/site-venv
venv_packages="numpy==2.4.6 scipy==1.17.1 matplotlib==3.11.2 Sphinx==9.0.4 myst-parser==5.2.0 furo==2025.12.19 breathe==5.1.0"
need_venv
if [ -z "${BAUM_LIBRARY:-}" ]; then
  # shellcheck disable=SC2086
  need_packages $build_packages
  build release release -DBAUM_TESTS=OFF
  BAUM_LIBRARY=$PWD/build/release/libbaum.so
fi
export BAUM_LIBRARY PYTHONPATH="$PWD/bindings/python" PYTHONDONTWRITEBYTECODE=1 MPLBACKEND=agg
python=$PWD/$venv/bin/python
source=$PWD/build/site-source

# The pages are copied, because generated pages join them. Folders to which pages refer are links.
rm -rf "$source" build/site build/site-doctrees build/site-extra
mkdir -p "$source/bindings/python" build/site-doxygen
cp -Rp docs "$source/docs"
cp -p docs/site/index.md "$source"
sed '1s/.*/# Overview/' README.md >"$source/README.md"  # the first page is called baum, too
cp -p bindings/python/README.md "$source/bindings/python"
ln -s "$PWD/include" "$PWD/examples" "$PWD/LICENSE" "$source"

heading "C reference"
{
  # With GENERATE_HTML = NO, doxygen 1.9.4 would report every parameter as undocumented.
  cat docs/Doxyfile
  echo "OUTPUT_DIRECTORY = build/site-doxygen"
  echo "GENERATE_XML = YES"
  echo "XML_PROGRAMLISTING = NO"
} | doxygen -

heading "pictures and pages of mechanisms"
"$python" docs/site/gallery.py "$source" build/site-extra
"$python" docs/site/modelling.py build/site-doxygen/xml "$source/modelling" build/site-extra/modelling/pictures
"$python" docs/site/reference.py build/site-doxygen/xml "$source/reference"

heading "site"
"$python" -m sphinx -b html -c docs/site -d build/site-doctrees --fail-on-warning --keep-going --quiet \
  "$source" build/site
rm -f build/site/.buildinfo build/site/objects.inv
echo "$(find build/site -name '*.html' | wc -l) files of HTML, $(du -sh build/site | cut -f 1): build/site/index.html"
