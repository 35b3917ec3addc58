# SPDX-License-Identifier: BSD-3-Clause
"""Typesets the plain notation of docs/notation.md on the pages of the site: lambda becomes a Greek letter, J^T gets a
superscript, and Phi_tq a subscript. Names in Python, such as B.phi and lambda_, do not change. If a text names another
page by its file, such as study.md, a link with the title of that page replaces the name. Code does not change, and neither
does the text that the search finds."""

import re
import unicodedata

from docutils import nodes
from sphinx.writers.html5 import HTML5Translator

GREEK = "alpha beta gamma delta epsilon zeta theta kappa lambda mu nu pi rho sigma tau phi psi omega Phi"
NAME = re.compile(rf"(?<!\w)(?<!\w\.)(?<![a-z]-)({GREEK.replace(' ', '|')})(?![a-zA-Z0-9]|_\w{{4}}|_(?!\w)| function)")
RAISED = re.compile(r"(?<=[\w)\]|'])\^(-?(?:[A-Z]|\d+(?:[/.]\d+)?)|[a-z]+|\*|\([^() ]+\))(?!\w)")
LOWERED = re.compile(r"(?<!\w)([A-Za-z\u0370-\u03ff]|(?<=\)))_([a-zA-Z0-9]{1,3})(?!\w)")
PAGE = re.compile(r"(?<![\w/-])(?:\.\./)*((?:[\w-]+/)*[\w-]+)\.md(?!\w)")
SUPERSCRIPTS = str.maketrans("0123456789-T", "⁰¹²³⁴⁵⁶⁷⁸⁹⁻ᵀ")
# These pages quote messages of the library, so their text is not typeset.
QUOTING = {"docs/messages", "docs/cookbook/warnings"}


def letter(found):
    case = "CAPITAL" if found[1][0].isupper() else "SMALL"
    return unicodedata.lookup(f"GREEK {case} LETTER {found[1].upper().replace('LAMBDA', 'LAMDA')}")


def typeset(html):
    """Return HTML with Greek letters, superscripts and subscripts."""
    html = RAISED.sub(r"<sup>\1</sup>", NAME.sub(letter, html))
    return LOWERED.sub(r"\1<sub>\2</sub>", html)


def typeset_line(line, wide):
    """Return a line of an equation in Unicode. If `wide` is true, the columns of matrices stay aligned."""
    new = NAME.sub(lambda m: letter(m).ljust(len(m[1]) if wide else 1), line)
    new = re.sub(
        r"\^(-?\d|T)(?![\w/])",
        lambda m: m[1].translate(SUPERSCRIPTS).ljust(len(m[0]) if wide else 1),
        new,
    )
    return new


def move_numbers(lines):
    """Move the numbers of equations from the right margin to the longest line, so that a phone shows them, too."""
    parts = [re.fullmatch(r"(.*?)(?: {3,}(\(\d+\)))?", line).groups() for line in lines]
    width = max(len(equation) for equation, _ in parts) + 4
    return [equation.ljust(width) + number if number else equation for equation, number in parts]


class Translator(HTML5Translator):
    def visit_Text(self, node):
        before = len(self.body)
        super().visit_Text(node)
        # The names of parameters must agree with the signatures.
        if self.protect_literal_text or isinstance(node.parent, (nodes.strong, nodes.field_name)):
            return
        linked = any(isinstance(x, nodes.reference) for x in (node.parent, node.parent.parent))
        html = PAGE.sub(lambda found: self.link(found, linked), "".join(self.body[before:]))
        self.body[before:] = [html if self.builder.current_docname in QUOTING else typeset(html)]

    def link(self, found, linked):
        """Return the title of a page that a text names by its file. It is a link, unless the text is part of a link already."""
        titles = self.builder.env.titles
        names = [name for name in titles if name.startswith("docs/") and f"/{name}".endswith(f"/{found[1]}")]
        if len(names) != 1:
            return found[0]
        title = re.split("[:,]", titles[names[0]].astext())[0]
        path = self.builder.get_relative_uri(self.builder.current_docname, names[0])
        return title if linked else f'<a class="reference internal" href="{path}">{title}</a>'

    def visit_literal_block(self, node):
        name = self.builder.current_docname
        plain = node.get("language", "none") == "none"
        if plain and name.startswith(("docs/theory/", "docs/notation", "docs/space")):
            lines = node.astext().split("\n")
            wide = len(lines) > 1 and "[" in lines[0]
            node.rawsource = "\n".join(move_numbers([typeset_line(line, wide) for line in lines]))
            node.children = [nodes.Text(node.rawsource)]
        super().visit_literal_block(node)


def setup(app):
    app.set_translator("html", Translator)
    return {"version": "1", "parallel_read_safe": True, "parallel_write_safe": True}
