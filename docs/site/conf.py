# SPDX-License-Identifier: BSD-3-Clause
"""Settings of Sphinx for the documentation site, see docs/build.sh."""

import sys
from pathlib import Path

import baum

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "docs" / "site"))

project = "baum"
author = "the authors of baum"
version = release = baum.library_version
extensions = ["myst_parser", "breathe", "sphinx.ext.autodoc", "docstrings", "equations", "links", "tabs"]
exclude_patterns = ["examples", "include", "docs/site"]
highlight_language = "none"
smartquotes = False  # Phi'' is a second derivative

myst_heading_anchors = 4
myst_enable_extensions = ["html_image"]
breathe_projects = {"baum": str(ROOT / "build" / "site-doxygen" / "xml")}
breathe_default_project = "baum"
breathe_domain_by_extension = {"h": "c"}
breathe_show_include = False

autodoc_member_order = "bysource"
autodoc_typehints = "none"  # type hints are long; baum.typing explains them
python_use_unqualified_type_names = True
python_maximum_signature_line_length = 88

html_theme = "furo"
html_title = f"baum {release}"
html_static_path = ["static"]
html_extra_path = [str(ROOT / "build" / "site-extra")]
html_css_files = ["site.css"]
html_js_files = ["tabs.js"]
html_copy_source = False
html_show_sourcelink = False
html_show_sphinx = False
html_show_copyright = False
html_use_index = True
html_theme_options = {"top_of_page_buttons": []}
