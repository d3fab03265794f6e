#!/usr/bin/env python3
"""Table and plot of bench/configs/quality.json.

usage: quality.py RESULTS.csv TABLE.md PLOT.svg

RESULTS.csv is that of `dvrlab run bench/configs/quality.json`. The plot is drawn by gnuplot: PSNR over the step, one frame per
field and width.
"""
import csv
import pathlib
import subprocess
import sys
import tempfile

ESTIMATORS = ["direct", "approximative", "preintegrated"]


def name_of(label):
    return next(e for e in ESTIMATORS if label.startswith(e))


def field_of(label):
    for known, name in (("radial", "radial"), ("marschner", "Marschner-Lobb"), ("nrrd", "engine")):
        if known in label:
            return name
    return label


def read(results):
    """{(field, width): {estimator: {step: psnr}}}"""
    found = {}
    with open(results, newline="") as file:
        for row in csv.DictReader(file):
            if row["role"] != "case" or not row.get("psnr against truth"):
                continue
            curve = found.setdefault((field_of(row["data"]), float(row["panel"])), {})
            curve.setdefault(name_of(row["estimator"]), {})[float(row["sampling.step"])] = float(row["psnr against truth"])
    return found


def table(found):
    steps = sorted({s for curves in found.values() for c in curves.values() for s in c}, reverse=True)
    lines = ["| field | pulse width | estimator | " + " | ".join(f"step {s:g}" for s in steps) + " |",
             "|---" * (3 + len(steps)) + "|"]
    for (field, width), curves in found.items():
        for e in ESTIMATORS:
            lines.append(f"| {field} | {width:g} | {e} | " + " | ".join(f"{curves[e][s]:.1f}" for s in steps) + " |")
    return "\n".join(lines) + "\n"


def plot(found, file):
    with tempfile.TemporaryDirectory() as folder:
        script = [f"set terminal svg size 1200,850 font 'sans,11' background 'white'", f"set output '{file}'",
                  "set logscale x 2", "set xrange [2.2:0.055]", "set key bottom right", "set grid",
                  "set xtics (2, 1, 0.5, 0.25, 0.125, 0.0625)", "set yrange [0:110]", "set multiplot layout 3,4"]
        for k, ((field, width), curves) in enumerate(found.items()):
            parts = []
            for e in ESTIMATORS:
                data = pathlib.Path(folder) / f"{k}_{e}"
                data.write_text("".join(f"{s} {min(p, 110)}\n" for s, p in sorted(curves[e].items())))
                parts.append(f"'{data}' with linespoints title '{e}'")
            script += [f"set title '{field}, width {width:g}'", "plot " + ", ".join(parts)]
            script.append("unset key" if k == 0 else "")
        subprocess.run(["gnuplot"], input="\n".join(script), text=True, check=True)


if __name__ == "__main__":
    if len(sys.argv) != 4:
        sys.exit(__doc__)
    data = read(sys.argv[1])
    pathlib.Path(sys.argv[2]).write_text(table(data))
    plot(data, sys.argv[3])
