#!/usr/bin/env python3
"""Installs into a temporary prefix, makes a plugin of every kind there with `dvrlab new-plugin`, builds all of them
outside of the source tree with find_package(dvrlab), and renders their examples through --plugin-path.

  sdk_test.py BUILD_FOLDER CMAKE COMPILER LAUNCHER FLAGS
"""
import json
import os
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

KINDS = ["data", "sampler", "optical_model", "estimator", "illumination", "metric", "backend"]
build, cmake, compiler, launcher, flags = sys.argv[1:6]


def run(*command, code=0, cwd=None):
    """The output of a command, which must end with this exit code."""
    environment = {k: v for k, v in os.environ.items() if k != "DVRLAB_PLUGIN_PATH"}
    done = subprocess.run(command, cwd=cwd, env=environment, text=True, stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
    if done.returncode != code:
        sys.exit(f"{' '.join(map(str, command))}: exit code {done.returncode}, expected {code}\n{done.stdout}")
    return done.stdout


def configure(source, target, package):
    run(cmake, "-G", "Ninja", "-S", source, "-B", target, f"-Ddvrlab_DIR={package}", f"-DCMAKE_CXX_COMPILER={compiler}",
        f"-DCMAKE_CXX_COMPILER_LAUNCHER={launcher}", f"-DCMAKE_CXX_FLAGS={flags}")


def main(folder):
    prefix, source, target = folder / "prefix", folder / "source", folder / "build"
    run(cmake, "--install", build, "--prefix", prefix)
    dvrlab = prefix / "bin/dvrlab"
    for kind in KINDS:
        run(dvrlab, "new-plugin", kind, f"mine_{kind}", "--out", source)
        left = [p for p in (source / f"mine_{kind}").iterdir() if "my_" in p.name or "my_" in p.read_text()]
        if left:
            sys.exit(f"new-plugin {kind} left the template's name in {left}")
    lists = "".join(f"add_subdirectory(mine_{kind})\n" for kind in KINDS)
    (source / "CMakeLists.txt").write_text(
        "cmake_minimum_required(VERSION 3.25)\nproject(mine LANGUAGES CXX)\nset(CMAKE_BUILD_TYPE Release)\nenable_testing()\n" + lists)
    configure(source, target, prefix / "lib/cmake/dvrlab")
    # One test of the seven: they are compiled in the source tree's build as well.
    targets = [f"dvrlab_{kind}_mine_{kind}" for kind in KINDS] + ["dvrlab_metric_mine_metric_test"]
    run(cmake, "--build", target, "-j", "2", "--target", *targets)

    plugins = target / "plugins"
    for kind in KINDS:
        example = plugins / kind / f"mine_{kind}" / f"mine_{kind}.example.json"
        # Without its folder nobody knows the plugin: the negative control.
        if f"mine_{kind}" not in run(dvrlab, "validate", example, code=2):
            sys.exit(f"the error does not name mine_{kind}")
        run(dvrlab, "--plugin-path", plugins, "run", example, "--out", folder / "out")
        cases = list((folder / "out" / f"mine_{kind}.example" / "cases").glob("*/case.json"))
        samples = [json.loads(c.read_text())["backend"]["counters"]["samples"] for c in cases]
        if not samples or min(samples) == 0:
            sys.exit(f"mine_{kind}: the example composited no sample ({len(cases)} cases)")
        print(f"mine_{kind}: {len(cases)} cases, {sum(samples)} samples")
    # What carries a kernel was built in double as well, and renders so.
    for kind in ["sampler", "estimator"]:
        folder_of = plugins / kind / f"mine_{kind}"
        if not (folder_of / f"mine_{kind}.fp64.so").exists():
            sys.exit(f"mine_{kind} has no kernel module in fp64")
        out = folder / "out64"
        run(dvrlab, "--plugin-path", plugins, "run", folder_of / f"mine_{kind}.example.json", "--out", out, "--set", "precision=fp64")
        drivers = [json.loads(c.read_text())["backend"]["driver"] for c in out.glob(f"mine_{kind}.example/cases/*/case.json")]
        if not drivers or set(drivers) != {"kernel modules fp64"}:
            sys.exit(f"mine_{kind} in fp64 ran on {drivers}")
        print(f"mine_{kind}: {len(drivers)} cases in fp64")
    print(run(cmake.replace("cmake", "ctest"), "--test-dir", target, "-R", "metric[.]mine_metric", "--no-tests=error"))

    # One folder by itself, against the build tree instead of the prefix.
    alone = folder / "alone"
    configure(source / "mine_metric", alone, Path(build) / "lib/cmake/dvrlab")
    run(cmake, "--build", alone, "--target", "dvrlab_metric_mine_metric")
    if "mine_metric" not in run(Path(build) / "bin/dvrlab", "--plugin-path", alone / "plugins", "list", "metric"):
        sys.exit("the plugin that was built against the build tree is not listed")

    # Another compiler has another ABI: the package says so instead of building what cannot be loaded.
    script = folder / "other_compiler.cmake"
    script.write_text(f'set(CMAKE_CXX_COMPILER_ID Other)\nset(CMAKE_CXX_COMPILER_VERSION 1.0)\n'
                      f'find_package(dvrlab REQUIRED PATHS "{prefix}" NO_DEFAULT_PATH)\n')
    said = subprocess.run([cmake, "-P", script], text=True, capture_output=True)
    if said.returncode == 0 or "Other-1" not in said.stderr:
        sys.exit(f"another compiler is not refused: {said.stderr}")
    print("another compiler is refused; one plugin builds against the build tree")


if __name__ == "__main__":
    folder = Path(tempfile.mkdtemp(prefix="dvrlab_sdk_"))
    try:
        main(folder)
    finally:
        shutil.rmtree(folder)
