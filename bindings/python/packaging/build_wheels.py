#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Build Python packages for all systems on one Debian machine. The C compiler zig builds the
libraries. They contain the parts of SuiteSparse and SUNDIALS that they need, built from Debian's
source packages.

usage: python3 build_wheels.py [TARGET...]

TARGET is a key of TARGETS, or sdist. By default the program builds all of them.

Writes into build/wheels/out. Needs cmake and ninja, and apt or the two archives of SOURCES in
build/wheels/sources. For the target wasm32-wasi, the program makes an archive of static libraries
and headers instead. For sdist, it makes the source archive of the Python package.
"""

from __future__ import annotations

import hashlib
import shutil
import subprocess
import sys
import tarfile
from pathlib import Path
from typing import NamedTuple

PROJECT = Path(__file__).resolve().parents[3]
WORK = PROJECT / "build" / "wheels"
OUT = WORK / "out"
BINDING = PROJECT / "bindings" / "python"
TOOLS = ["ziglang==0.17.1", "scikit-build-core==1.1.2", "wheel==0.48.0"]


class Source(NamedTuple):
    """An archive in the pool of Debian, and the folders in this archive that are needed."""

    path: str
    sha256: str
    folders: tuple[str, ...]


SOURCES = [
    Source(
        "pool/main/s/suitesparse/suitesparse_5.12.0+dfsg.orig.tar.xz",
        "bb106c43049138c19675cd70322e72ff8e4fd8bdcab3a096307fd78488913faf",
        ("AMD", "BTF", "COLAMD", "KLU", "SuiteSparse_config"),
    ),
    Source(
        "pool/main/s/sundials/sundials_6.4.1+dfsg1.orig.tar.xz",
        "c61157f1d4be06c704bea40cb131eb63ba2dada161989071604d0a0959cdf04a",
        ("src", "include", "CMakeLists.txt", "LICENSE", "NOTICE"),
    ),
]


class Target(NamedTuple):
    """The names that zig, CMake (system and processor) and Python packages use for a system."""

    zig: str
    system: str
    processor: str
    tag: str


SDIST = "sdist"
SDIST_PARTS = ("CMakeLists.txt", "LICENSE", "cmake", "include", "src")
BINDING_PARTS = ("README.md", "pyproject.toml", "baum")

WASM = "wasm32-wasi"
TARGETS = {
    "linux-x86_64": Target(
        "x86_64-linux-gnu.2.17", "Linux", "x86_64", "manylinux_2_17_x86_64.manylinux2014_x86_64"
    ),
    "linux-aarch64": Target(
        "aarch64-linux-gnu.2.17", "Linux", "aarch64", "manylinux_2_17_aarch64.manylinux2014_aarch64"
    ),
    "macos-arm64": Target("aarch64-macos.11.0", "Darwin", "arm64", "macosx_11_0_arm64"),
    "macos-x86_64": Target("x86_64-macos.11.0", "Darwin", "x86_64", "macosx_11_0_x86_64"),
    "windows-x86_64": Target("x86_64-windows-gnu", "Windows", "AMD64", "win_amd64"),
    WASM: Target("wasm32-wasi", "Linux", "wasm32", ""),  # with "Linux", CMake assumes pthreads
}


def run(*command: object) -> str:
    """Return the output of a command. If the command fails, show its output and exit."""
    words = [str(word) for word in command]
    done = subprocess.run(words, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
    if done.returncode:
        sys.exit(f"{done.stdout}\nfailed: {' '.join(words)}")
    return done.stdout


def make_tools() -> Path:
    """Return the Python interpreter of a virtual environment in which TOOLS are installed."""
    python = WORK / "venv" / "bin" / "python"
    note = WORK / "venv" / "installed"
    if not note.exists() or note.read_text() != " ".join(TOOLS):
        run(sys.executable, "-m", "venv", "--clear", WORK / "venv")
        run(python, "-m", "pip", "install", "--quiet", *TOOLS)
        note.write_text(" ".join(TOOLS))
    return python


def fetch(source: Source) -> Path:
    """Return the archive of a source. If it is missing, get it from the mirror that apt uses."""
    file = WORK / "sources" / Path(source.path).name
    if not file.exists():
        targets = run("apt-get", "indextargets", "--format", "$(REPO_URI)", "Label: Debian")
        if not targets:
            sys.exit(f"apt has no Debian mirror here: put {file.name} into {file.parent}")
        uri = targets.split()[0] + source.path
        file.parent.mkdir(parents=True, exist_ok=True)
        run("/usr/lib/apt/apt-helper", "download-file", uri, file, "SHA256:" + source.sha256)
    found = hashlib.sha256(file.read_bytes()).hexdigest()
    if found != source.sha256:
        sys.exit(f"{file} has the SHA-256 digest {found}, must have {source.sha256}")
    return file


def unpack() -> Path:
    """Return the folder with the sources of SuiteSparse and SUNDIALS."""
    folder = WORK / "unpacked"
    note = folder / "whole"
    wanted = "".join(source.sha256 for source in SOURCES)
    if note.exists() and note.read_text() == wanted:
        return folder
    shutil.rmtree(folder, ignore_errors=True)
    for source in SOURCES:
        with tarfile.open(fetch(source)) as archive:
            members = [
                m
                for m in archive
                if m.name.split("/")[1:2] and m.name.split("/")[1] in source.folders
            ]
            archive.extractall(folder, members)
    note.write_text(wanted)
    return folder


def settings_for(target: Target, folder: Path, python: Path, sources: Path) -> dict[str, object]:
    """Return CMake variables for a target. Write commands for the target's compiler, ar and ranlib
    into `folder`."""
    zig = Path(run(python, "-c", "import ziglang; print(ziglang.__path__[0])").strip()) / "zig"
    folder.mkdir(parents=True, exist_ok=True)
    for name, words in {"cc": f"cc -target {target.zig}", "ar": "ar", "ranlib": "ranlib"}.items():
        (folder / name).write_text(f'#!/bin/sh\nexec "{zig}" {words} "$@"\n')
        (folder / name).chmod(0o755)
    licenses = [zig.with_name("LICENSE")]
    if target.system == "Windows":
        licenses.append(zig.with_name("lib") / "libc" / "mingw" / "COPYING")
    # These flags make the packages small. The linker omits the functions that baum does not use. On
    # Linux, the tables for C++ exceptions are omitted, because C does not need them.
    flags = "-g0 -ffunction-sections -fdata-sections -DBAUM_I_CPUID"  # see src/base/hot.c
    if target.system == "Linux":
        flags += " -fno-unwind-tables -fno-asynchronous-unwind-tables"
    # The hot files (src/base/hot.h) are always compiled with -O3. Code for Windows is larger: with
    # -O2 for the other files, the package for Windows would have 1.7 MB. With -Os for these files,
    # runs take 3 to 15 % longer than with -O2.
    optimize = "-Os" if target.system == "Windows" else "-O2"
    link = "-s -Wl,-dead_strip" if target.system == "Darwin" else "-s -Wl,--gc-sections"
    return {
        "BAUM_BUNDLED": sources,
        "BAUM_RUNTIME_LICENSES": ";".join(map(str, licenses)),
        "CMAKE_SYSTEM_NAME": target.system,
        "CMAKE_SYSTEM_PROCESSOR": target.processor,
        "CMAKE_C_COMPILER": folder / "cc",
        "CMAKE_AR": folder / "ar",
        "CMAKE_RANLIB": folder / "ranlib",
        "CMAKE_BUILD_WITH_INSTALL_RPATH": "ON",
        "CMAKE_BUILD_WITH_INSTALL_NAME_DIR": "ON",
        "CMAKE_INSTALL_NAME_DIR": "@loader_path",
        "CMAKE_C_FLAGS": flags,
        "CMAKE_SHARED_LINKER_FLAGS": link,
        "CMAKE_C_STANDARD_LIBRARIES": "",  # baum needs no libraries of Windows
        "CMAKE_BUILD_TYPE": "Release",
        "CMAKE_C_FLAGS_RELEASE": optimize + " -DNDEBUG",
    }


def build_wheel(name: str, target: Target, settings: dict[str, object], python: Path) -> Path:
    """Build and return the package for a target."""
    made = WORK / name / "wheel"
    shutil.rmtree(made, ignore_errors=True)
    options = [f"--config-settings=cmake.define.{key}={value}" for key, value in settings.items()]
    options.append(f"--config-settings=build-dir={WORK / name / 'cmake'}")
    wheel = [python, "-m", "pip", "wheel", BINDING, "--no-deps", "--no-build-isolation"]
    run(*wheel, "--wheel-dir", made, *options)
    (untagged,) = made.glob("*.whl")
    tag = run(python, "-m", "wheel", "tags", "--platform-tag", target.tag, untagged)
    return Path(shutil.move(made / tag.split()[-1], OUT / tag.split()[-1]))


def build_archive(name: str, settings: dict[str, object]) -> Path:
    """Build and return an archive of static libraries and headers, for a target without shared
    libraries."""
    build = WORK / name / "cmake"
    options = [f"-D{key}={value}" for key, value in settings.items()]
    options += ["-DBAUM_TESTS=OFF", "-DBAUM_EXAMPLES=OFF", "-GNinja"]
    run("cmake", "-S", PROJECT, "-B", build, *options)
    run("cmake", "--build", build, "--target", "baum_static", "baum_catalog_static")
    file = OUT / f"baum-{name}.tar.gz"
    with tarfile.open(file, "w:gz") as archive:
        for library in ("libbaum.a", "libbaum_catalog.a"):
            archive.add(build / library, f"lib/{library}")
        archive.add(PROJECT / "include", "include")
        archive.add(PROJECT / "LICENSE", "licenses/LICENSE")
        archive.add(build / "licenses", "licenses")
    return file


def build_target(name: str, python: Path) -> Path:
    """Build and return the package or archive for a target."""
    target = TARGETS[name]
    settings = settings_for(target, WORK / name / "bin", python, unpack())
    if name == WASM:
        return build_archive(name, settings)
    return build_wheel(name, target, settings, python)


def build_sdist(python: Path) -> Path:
    """Build and return the source archive. It also contains the C sources, which are outside of the
    folder of the package."""
    folder = WORK / SDIST
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir(parents=True)
    unwanted = shutil.ignore_patterns("__pycache__")
    for part in [*(PROJECT / name for name in SDIST_PARTS), *map(BINDING.joinpath, BINDING_PARTS)]:
        if part.is_dir():
            shutil.copytree(part, folder / part.name, ignore=unwanted)
        else:
            shutil.copy(part, folder)
    build = "import os, sys; os.chdir(sys.argv[1]); import scikit_build_core.build as b; "
    said = run(python, "-c", build + "print(b.build_sdist(sys.argv[2]))", folder, OUT)
    return OUT / said.split()[-1]


def main() -> None:
    known = [*TARGETS, SDIST]
    names = sys.argv[1:] or known
    for name in names:
        if name not in known:
            sys.exit(f"no target {name}; there are: {' '.join(known)}")
    python = make_tools()
    OUT.mkdir(parents=True, exist_ok=True)
    for name in names:
        if name == SDIST:
            made = build_sdist(python)
        else:
            made = build_target(name, python)
        print(f"{made.stat().st_size / 1e6:.2f} MB {made.relative_to(PROJECT)}", flush=True)


main()
