# SPDX-License-Identifier: BSD-3-Clause
"""Makes links of the names of files. A link to a header leads to its page in the C reference instead of a download. The
name of a program in examples/, such as `examples/cart_pole.py`, becomes a link to the page of the gallery that shows it."""

import re

from docutils import nodes
from gallery import IN_C
from sphinx.util.nodes import make_refnode

HEADER = re.compile(r"\]\((?:\.\./)*include/baum/(\w+)\.h\)")
EXAMPLE = re.compile(r"examples/(\w+)\.(py|c)")
SHOWN_BY = {program: name for name, programs in IN_C.items() for program in programs}


def link_headers(app, docname, source):
    source[0] = HEADER.sub(r"](/reference/c/\1.md)", source[0])


def link_examples(app, doctree, docname):
    for literal in list(doctree.findall(nodes.literal)):
        found = EXAMPLE.fullmatch(literal.astext())
        if not found or isinstance(literal.parent, nodes.reference):
            continue
        names = [found[1], *([SHOWN_BY[found[1]]] if found[1] in SHOWN_BY else [])]
        pages = [f"gallery/{name}" for name in names if f"gallery/{name}" in app.env.found_docs]
        if pages and pages[0] != docname:
            literal.replace_self(make_refnode(app.builder, docname, pages[0], None, literal.deepcopy()))


def setup(app):
    app.connect("source-read", link_headers)
    app.connect("doctree-resolved", link_examples)
    return {"version": "1", "parallel_read_safe": True, "parallel_write_safe": True}
