#!/usr/bin/env python3
"""Runs the experiments of the papers and renews the panels and plots in their folders.

usage: papers.py DVRLAB [NAME ...]

Every config below configs/papers is run (or those whose path holds a NAME) into out/papers. Of every case with a `panel`,
on the first backend, the image goes to <config without .json>/<panel>.png; its transfer functions are drawn to
tf_<panel>.svg there, unless they are those of an earlier panel. Ends with the worst exit code of the runs.
"""
import json
import pathlib
import shutil
import subprocess
import sys

ROOT = pathlib.Path("configs/papers")
OUT = pathlib.Path("out/papers")


def panels_of(results):
    """(panel, folder) of the cases that are shown, the first variant of each, in the order of their panels."""
    found = {}
    for file in sorted(results.glob("cases/*/case.json")):
        record = json.loads(file.read_text())
        panel = record["config"].get("panel", "")
        first = record["report"]["role"] == "case" and "variant" not in record["metrics"]
        if panel and first and (file.parent / "image.png").exists():
            found[panel] = file.parent
    return sorted(found.items())


def renew(dvrlab, config, results):
    folder = config.with_suffix("")
    folder.mkdir(exist_ok=True)
    drawn = {}
    for panel, case in panels_of(results):
        shutil.copy(case / "image.png", folder / f"{panel}.png")
        plot = folder / f"tf_{panel}.svg"
        subprocess.run([dvrlab, "info", case / "case.json", "--plot", plot], check=True, stdout=subprocess.DEVNULL)
        if plot.read_bytes() in drawn.values():
            plot.unlink()
        else:
            drawn[panel] = plot.read_bytes()


def main(dvrlab, names):
    worst = 0
    for config in sorted(ROOT.glob("*/*.json")):
        if names and not any(name in str(config) for name in names):
            continue
        print(f"papers: {config}", file=sys.stderr)
        out = OUT / config.parent.name
        tables = {"yang2012": ["tools/paper_table.py", "--times"], "lee_shin2013": ["tools/lee_shin_tables.py", f"--{config.stem}"],
                  "hernell2008": ["tools/hernell_tables.py"]}.get(config.parent.name)
        if config.parent.name == "lee_shin2013" and config.stem in ("table1", "table2"):  # of tables, not of images
            subprocess.run([sys.executable, *tables, dvrlab], check=True)
            continue
        run = subprocess.run([dvrlab, "run", config, "--out", out])
        worst = max(worst, abs(run.returncode))  # negative: ended by a signal
        if tables and config.stem.startswith("table"):
            subprocess.run([sys.executable, *tables, out / config.stem], check=True)
        else:
            renew(dvrlab, config, out / config.stem)
    return worst


if __name__ == "__main__":
    if len(sys.argv) < 2:
        sys.exit(__doc__)
    sys.exit(main(sys.argv[1], sys.argv[2:]))
