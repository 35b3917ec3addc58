# SPDX-License-Identifier: BSD-3-Clause
"""Checks or writes docs/messages.md, which lists every message and every warning of the library.
The program finds them in the sources in src.

usage: check_messages.py --check|--write PROJECT
       check_messages.py --untriggered COVERAGE_JSON PROJECT

With --check, the program compares the page with the sources. With --write, it writes the page. In
both cases it fails if a message has more than three clauses. With --untriggered, the program reads
which lines the tests executed (gcovr --json, stage coverage). It lists the messages that no test
has triggered. If a message is in the same line as a condition, it counts as triggered only if both
outcomes of the condition occurred.
"""

import json
import re
import sys
from pathlib import Path

# The functions that set a message. For each, the positions of two arguments: the status or code,
# and the format.
SINKS = {"baum_i_fail": (0, 1), "baum_i_run_warn": (1, 4), "baum_i_catalog_fail": (0, 1), "baum_fail": (0, 1)}
MOST_CLAUSES = 3
LITERAL = re.compile(r'"((?:[^"\\]|\\.)*)"')
# What stands in the list for a text of a message, by the name at the end of the C expression that
# gives the text. All other texts are "...".
PLACEHOLDERS = {"call": "CALL", "label": "ELEMENT", "r->label": "SOURCE", "p->label": "SOURCE",
                "event_label": "EVENT", "joint_label": "JOINT", "row_label": "JOINT", "name": "NAME", "names": "NAMES",
                "integrator": "INTEGRATOR", "integrator->name": "INTEGRATOR", "method->name": "INTEGRATOR",
                "pair->name": "INTEGRATOR", "field": "FIELD", "key": "KEY", "unit": "UNIT", "unit_of": "UNIT", "kind": "KIND",
                "path": "PATH", "family": "FAMILY", "user_entry": "ENTRY", "coordinate_name": "COORDINATE"}
SPEC = re.compile(r"%[-+ #0-9.*]*(?:ll|l|z|h)?[a-zA-Z%]")
HEAD = """# Messages

This page lists every message and warning of the library. `python3 tests/layout/check_messages.py --write .` generates this page
from the sources. In the tables, `#` stands for a number, and words in capital letters stand for texts:

- `CALL` is the name of the function that was called.
- `ELEMENT` and `JOINT` are the kind, number and name of an element, such as `joint 2 "B"`.
- `ENTRY` names one number in the result of a user function, such as `joint 2 "B": gamma()[0]`.
- `SOURCE` is the path of the file that is read, or the word `scene`.

`{A / B}` stands for one of the texts A and B, and `...` for any other text. In the first column, *as failed* means that the
text is added to the message of an earlier failure, whose status does not change. Each warning links to its section of the page
"[cookbook/warnings.md](cookbook/warnings.md)". The page "[theory/errors.md](theory/errors.md)" describes the warnings that put
a result in doubt, and the header [status.h](../include/baum/status.h) describes the statuses. `sh tests/run.sh coverage` lists
the messages that no test triggers.
"""


def placeholder(expression):
    """Return what stands for a text in the message, from the C expression of the text."""
    either = re.search(r'\? "([^"]*[a-z][^"]*)" : "([^"]*[a-z][^"]*)"$', expression)
    if either:
        return f"{{{either[1]} / {either[2]}}}"
    end = re.search(r"((?:\w+->)?)(?:baum_i_)?(\w+)(?:\(.*\))?(?:\.text)?$", expression, flags=re.S)
    if not end or "?" in expression:
        return "..."
    return PLACEHOLDERS.get(end[1] + end[2]) or PLACEHOLDERS.get(end[2], "...")


def without_comments(text):
    return re.sub(r"/\*.*?\*/", lambda m: re.sub(r"[^\n]", " ", m[0]), text, flags=re.S)


def arguments_at(text, opening):
    """Return the arguments of a call and its end. The call's parenthesis opens at the position
    `opening`."""
    depth, start, found, k = 0, opening + 1, [], opening
    while k < len(text):
        quote = re.compile(r'"(?:[^"\\]|\\.)*"|\'(?:[^\'\\]|\\.)*\'').match(text, k)
        if quote:
            k = quote.end()
            continue
        depth += (text[k] in "([{") - (text[k] in ")]}")
        if depth == 0 or depth == 1 and text[k] == ",":
            found.append(text[start:k].strip())
            start = k + 1
            if depth == 0:
                return found, k
        k += 1
    raise SystemExit(f"no end of the call at {text[opening - 40:opening]}")


class Source:
    """One source file, with its macros, tables of texts, functions and messages."""

    def __init__(self, path, name):
        self.name, self.text = name, without_comments(path.read_text(encoding="utf-8"))
        self.strings = dict(re.findall(r'(?m)^#define (\w+) ("(?:[^"\\]|\\.)*")$', self.text))
        self.sinks, self.messages = dict(SINKS), []
        joined = self.text.replace("\\\n", "  ")
        for macro, sink, code, prefix in re.findall(r'(?m)^#define (\w+)\(\.\.\.\)\s+(\w+)\((\w+),\s*("[^"]*") __VA_ARGS__\)', joined):
            self.sinks[macro] = code, prefix
        self.functions = re.findall(r"(?m)^(?:static )?[\w ]+?[ *](\w+)\(([^;{}]*?)\)\n\{\n(.*?)^\}", self.text, flags=re.S)

    def literals(self, expression):
        """Return all texts that can be the value of an expression. There is one for each branch of
        a condition, and for each entry of a table."""
        for name, value in self.strings.items():
            expression = re.sub(rf"\b{name}\b", lambda _, v=value: v, expression)
        table = re.match(r"(\w+)\[", expression)
        if table:
            entries = re.search(rf"\b{table[1]}\[[^=;]*\] = \{{(.*?)\n?\}};", self.text, flags=re.S)
            expression = entries[1] if entries else ""
        texts = re.findall(r'"(?:[^"\\]|\\.)*"(?:\s*"(?:[^"\\]|\\.)*")*', expression)
        return ["".join(LITERAL.findall(t)) for t in texts]

    def calls(self, function):
        for m in re.finditer(rf"\b{function}\(", self.text):
            before = self.text[:m.start()].rsplit("\n", 1)[-1]
            if not re.match(r"#define|(static )?(baum_status|int|void) \Z", before):
                arguments, end = arguments_at(self.text, m.end() - 1)
                yield m.start(), end, arguments

    def add(self, start, end, code, texts):
        first = self.text[:start].count("\n") + 1
        self.messages += [(code, text, first, self.text[:end].count("\n") + 1) for text in texts]

    def expanded(self, template, values):
        """Return the variants of a format. If the texts that replace a %s are known and consist of
        several words, each of these texts gives a variant. Otherwise a placeholder replaces the
        %s."""
        done = [template]
        for spec, value in zip([s for s in SPEC.finditer(template) if s[0] != "%%"], values):
            texts = [t for t in self.literals(value) if len(t) > 0]
            if spec[0].endswith("s"):
                texts = texts if any(" " in t for t in texts) else [placeholder(value)]
                mark = f"\0{spec.start()}\0"
                done = [d.replace(mark, t) for d in self.marked(done, template, spec, mark) for t in texts]
        return done

    @staticmethod
    def marked(done, template, spec, mark):
        behind = len(template) - spec.end()
        return [d[:len(d) - behind - len(spec[0])] + mark + (d[len(d) - behind:] if behind else "") for d in done]

    def read(self):
        for sink, (code, form) in self.sinks.items():
            for start, end, arguments in self.calls(sink):
                # If `code` is a text, the sink is a macro. `code` is then the status, and `form` the
                # beginning of the message.
                if isinstance(code, str):
                    texts, status, values = self.literals(form + " " + arguments[0]), code, arguments[1:]
                else:
                    texts, status, values = self.literals(arguments[form]), arguments[code], arguments[form + 1:]
                wrapper = self.wrapper_of(start, values)
                if wrapper:
                    self.read_wrapper(*wrapper, status, texts, values)
                else:
                    self.add(start, end, status, [t for text in texts for t in self.expanded(text, values)])
        self.messages.sort(key=lambda m: m[2])
        return self.messages

    def wrapper_of(self, start, values):
        """Find the function that contains a call. If the callers of this function give it texts,
        and it passes these texts on in the call, return its name and the parameters that are the
        texts."""
        for name, parameters, body in self.functions:
            at = self.text.find(body)
            if at <= start < at + len(body) and name not in SINKS:
                names = [re.search(r"(\w+)(?:\[\w*\])?$", p.strip())[1] for p in parameters.split(",")]
                passed = {v: names.index(v) for v in values if v in names}
                passed = {v: k for v, k in passed.items()
                          if any(" " in t for _, _, a in self.calls(name) if k < len(a) for t in self.literals(a[k]))}
                return (name, passed) if passed else None
        return None

    def read_wrapper(self, name, passed, status, texts, values):
        for start, end, arguments in self.calls(name):
            given = [arguments[passed[v]] if v in passed else v for v in values]
            self.add(start, end, status, [t for text in texts for t in self.expanded(text, given)])


def readable(text):
    text = text.replace('\\"', '"').replace("\\n", " ")
    text = SPEC.sub(lambda m: {"s": "...", "c": "LETTER", "%": "%"}.get(m[0][-1], "#"), text)
    text = re.sub(r"\.{4,}", "...", text)
    return " ".join(text.replace("|", "\\|").split())


def read(project):
    """Return {folder: [(file, code, text, first line, last line)]}."""
    found = {}
    for path in sorted((project / "src").rglob("*.c")):
        name = str(path.relative_to(project / "src"))
        for message in Source(path, name).read():
            if re.search(r"[A-Za-z]{2}", readable(message[1])):
                found.setdefault(name.split("/")[0], []).append((name, *message))
    return found


def entries_of(project):
    """Return {name of a warning's code: its entry in the cookbook}. Fails if an entry is missing."""
    header = (project / "include/baum/simulation.h").read_text(encoding="utf-8")
    cookbook = (project / "docs/cookbook/warnings.md").read_text(encoding="utf-8")
    entries = {}
    for name, number in re.findall(r"BAUM_WARNING_(\w+) = (\d+)", header):
        if f"\n## {number} {name.lower()}\n" not in cookbook:
            raise SystemExit(f"docs/cookbook/warnings.md has no entry {number} {name.lower()}")
        entries["BAUM_WARNING_" + name] = f"cookbook/warnings.md#{number}-{name.lower()}"
    return entries


def code_of(code, entries):
    codes = re.findall(r"BAUM_(?:ERR|STOP|WARNING)_\w+|BAUM_WARNED", code)
    return " or ".join(f"[`{c}`]({entries[c]})" if c in entries else f"`{c}`" for c in codes) or "as failed"


def page(found, entries):
    lines = [HEAD]
    for folder, messages in found.items():
        lines += [f"## {folder}", "", "| status or code | message | file |", "|---|---|---|"]
        rows = [f"| {code_of(code, entries)} | {readable(text)} | {name.split('/', 1)[1]} |" for name, code, text, *_ in messages]
        lines += [*dict.fromkeys(rows), ""]
    return "\n".join(lines)


def executed(path):
    """Return {file: {line: (count, whether all branches of the line were taken)}}."""
    with open(path, encoding="utf-8") as file:
        files = json.load(file)["files"]
    return {f["file"]: {line["line_number"]: (line["count"], all(b["count"] for b in line["branches"])) for line in f["lines"]}
            for f in files}


def untriggered(project, found, lines):
    for messages in found.values():
        for name, code, text, first, last in messages:
            counts = lines.get("src/" + name, {})
            source = (project / "src" / name).read_text(encoding="utf-8").split("\n")
            reached = [counts[k] for k in range(first, last + 1) if k in counts]
            shared = "?" in source[first - 1] and ":" in source[first - 1]
            if not any(count for count, _ in reached) or shared and not counts.get(first, (0, False))[1]:
                yield f"src/{name}:{first}: {code}: {readable(text)}"


def main(arguments):
    project = Path(arguments[-1])
    found = read(project)
    if arguments[0] == "--untriggered":
        missing = list(untriggered(project, found, executed(arguments[1])))
        print("\n".join(missing), f"\n{len(missing)} messages that no test triggers")
        return 0
    failures = [f"src/{name}:{first}: more than {MOST_CLAUSES} clauses: {readable(text)}"
                for messages in found.values() for name, _, text, first, _ in messages
                if len(re.findall(r"[.!?;](?= )", readable(text).replace("...", ""))) >= MOST_CLAUSES]
    target, text = project / "docs" / "messages.md", page(found, entries_of(project))
    if arguments[0] == "--write":
        target.write_text(text, encoding="utf-8")
    elif not target.exists() or target.read_text(encoding="utf-8") != text:
        failures.append("docs/messages.md is not current: python3 tests/layout/check_messages.py --write .")
    print("\n".join([*failures, f"{sum(map(len, found.values()))} messages"]))
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
