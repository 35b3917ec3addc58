# SPDX-License-Identifier: BSD-3-Clause
"""Tests that the Python copy of the C interface agrees with the headers, and with the sizes,
offsets and values that a C compiler finds in them."""

import ctypes
import importlib.util
import subprocess
import unittest
from pathlib import Path

from baum import _abi
from compiler import CC, ROOT, Folder


def tool(name):
    path = ROOT / "bindings" / "python" / "tools" / f"{name}.py"
    spec = importlib.util.spec_from_file_location(name, path)
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def generator():
    return tool("generate_abi")


def enums():
    return [
        value
        for value in vars(_abi).values()
        if isinstance(value, type) and issubclass(value, _abi.enum.IntEnum)
    ]


class Abi(unittest.TestCase):
    def test_generating_it_again_changes_nothing(self):
        for name, made in generator().generate(ROOT / "include").items():
            text = Path(_abi.__file__).with_name(name).read_text(encoding="utf-8")
            self.assertEqual(made, text, "run bindings/python/tools/generate_abi.py")

    def test_the_generator_refuses_what_it_does_not_know(self):
        tool = generator()
        for declaration in (
            "BAUM_API union baum_u baum_f(void)",
            "typedef long baum_long",
            "BAUM_API baum_unknown baum_f(void)",
            "BAUM_API int baum_f(int **a)",
        ):
            with self.assertRaisesRegex(SystemExit, "not understood"):
                tool.translate(declaration, tool.Writer())

    def test_a_result_without_a_comment_is_refused(self):
        text = "typedef struct baum_mobility {\n  int32_t rows; /* of J */\n} baum_mobility;"
        with self.assertRaisesRegex(SystemExit, "no comment on rows of baum_mobility"):
            generator().record(text, "baum_mobility", [("rows", "c_int32")])

    @unittest.skipUnless(CC, "no C compiler")
    def test_sizes_offsets_and_values_are_those_of_c(self):
        lines = []
        for struct in _abi.STRUCTS:
            name = struct.__name__
            lines.append(("%zu", f"sizeof({name})", ctypes.sizeof(struct)))
            lines += [
                ("%zu", f"offsetof({name}, {field})", getattr(struct, field).offset)
                for field, _ in struct._fields_
            ]
            lines += [
                ("%zu", f"sizeof((({name} *)0)->{field})", ctypes.sizeof(kind))
                for field, kind in struct._fields_
            ]
        for kind in enums():
            lines.append(("%zu", f"sizeof({kind.__name__})", ctypes.sizeof(ctypes.c_int)))
            lines += [("%d", value.name, value.value) for value in kind]
        prints = "".join(f'  printf("{form}\\n", {text});\n' for form, text, _ in lines)
        source = (
            "#include <baum/baum.h>\n#include <baum/catalog.h>\n#include <stddef.h>\n#include <stdio.h>\n"
            f"int main(void)\n{{\n{prints}  return 0;\n}}\n"
        )
        folder = Folder()
        self.addCleanup(folder.cleanup)
        program = folder.program(source)
        said = subprocess.run([program], check=True, capture_output=True, text=True).stdout.split()
        self.assertEqual(
            [f"{text} = {value}" for _, text, value in lines],
            [f"{text} = {value}" for (_, text, _), value in zip(lines, said)],
        )

    def test_every_function_of_the_headers_is_declared(self):
        text = "".join(
            path.read_text(encoding="utf-8") for path in (ROOT / "include" / "baum").glob("*.h")
        )
        for macro, prototypes in (
            ("BAUM_API ", _abi.PROTOTYPES),
            ("BAUM_CATALOG_API ", _abi.CATALOG_PROTOTYPES),
        ):
            self.assertEqual(text.count(macro) - text.count("#define " + macro), len(prototypes))


class Changes(unittest.TestCase):
    """Tests tools/compare_abi.py, which finds changes that break compiled programs. This tool is
    run for every release."""

    def found_after(self, *replacements):
        """Return the changes that are found after replacements in the text of _abi.py."""
        text = Path(_abi.__file__).read_text(encoding="utf-8")
        for old, new in replacements:
            self.assertIn(old, text)
            text = text.replace(old, new, 1)
        folder = Folder()
        self.addCleanup(folder.cleanup)
        path = Path(folder.name) / "changed.py"
        path.write_text(text, encoding="utf-8")
        comparison = tool("compare_abi")
        return comparison.changes(comparison.load(_abi.__file__), comparison.load(str(path)))

    def test_additions_break_nothing(self):
        # The last field of baum_driver_def, which begins with struct_size.
        last = '("coordinate", c_int),\n'
        value = "BAUM_STOP_TIME = 3\n"
        found = self.found_after(
            (value, value + "    BAUM_STOP_NEW = 4\n"),
            (last, last + '        ("new", c_double),\n'),
            ("PROTOTYPES = {\n", 'PROTOTYPES = {\n    "baum_new": (c_int, []),\n'),
        )
        self.assertEqual(found, [])

    def test_every_kind_of_break_is_found(self):
        version = '"baum_version": (c_char_p, ['
        index = '("index1", c_int32),'
        for old, new, expected in (
            ("BAUM_WARNED = 10", "BAUM_WARNED = 11", "enum baum_status: BAUM_WARNED"),
            ("    BAUM_WARNED = 10\n", "", "enum baum_status: BAUM_WARNED"),
            (version, '"baum_new": (c_char_p, [', "function baum_version() is missing"),
            (version, version + "c_int, ", "function baum_version(): arguments"),
            ("CFUNCTYPE(c_int, c_double,", "CFUNCTYPE(c_int, c_int,", "struct baum_user_constraint"),
            (index, index.replace("32", "64"), "struct baum_body_id: fields"),
            (index, index + '("new", c_int32),', "struct baum_body_id: fields"),
            ("STRUCTS = [\n    baum_body_id,", "STRUCTS = [", "struct baum_body_id is missing"),
        ):
            with self.subTest(new):
                self.assertTrue(
                    any(line.startswith(expected) for line in self.found_after((old, new)))
                )


if __name__ == "__main__":
    unittest.main()
