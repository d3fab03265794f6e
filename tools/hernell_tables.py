#!/usr/bin/env python3
"""Table 1 of Hernell et al. 2008, left and right, as a README of times from the results of its config.

usage: hernell_tables.py RESULTS
"""
import json
import pathlib
import sys

FOLDER = pathlib.Path("configs/papers/hernell2008")
SIDE = 512  # of the generated volume


def seconds(record, *stages):
    """Of the phases of these stages of the light volume, or of the march."""
    times = record["backend"]["times"]
    return sum(t["median_s"] for name, t in times.items() if name.removeprefix("light ").startswith(stages))


def cases(results):
    for file in sorted(results.glob("cases/*/case.json")):
        record = json.loads(file.read_text())
        if record["report"]["role"] == "case":
            pass_ = record["config"]["illumination"][0]
            yield record, SIDE // pass_["shadow_ratio"][0], pass_["segment"]


def table(head, rows):
    lines = ["| " + " | ".join(head) + " |", "|" + "---|" * len(head)]
    return lines + ["| " + " | ".join(str(cell) for cell in row) + " |" for row in rows]


def left(results):
    at = {}
    for record, size, _ in cases(results):
        row = at.setdefault(record["config"]["sampler"]["reduction"], {})
        row[size] = seconds(record, "segment", "shadow", "direct")
        row["B"] = min(row.get("B", 1e9), seconds(record, "scatter"))
        row["C"] = min(row.get("C", 1e9), seconds(record, "march"))
    head = ["data reduction", "A, shadow volume 32^3", "A, 256^3", "B", "C"]
    return table(head, [[r] + [f"{at[r][k]:.2f}" for k in (32, 256, "B", "C")] for r in sorted(at)])


def right(results):
    at = {}
    for record, size, segment in cases(results):
        at.setdefault(segment, {})[size] = seconds(record, "segment", "shadow", "direct")
    sizes = sorted({size for row in at.values() for size in row})
    return table(["segment, voxels"] + [f"{n}^3" for n in sizes], [[f"{s:g}"] + [f"{at[s][n]:.2f}" for n in sizes] for s in sorted(at)])


def main(results):
    name = results.name
    backend = next(cases(results))[0]["backend"]
    where = f"{backend['device']}, {backend['detail']}"
    text = [f"# {name}", "", "Seconds of the updates, from `./dev papers hernell2008/" + name + "`"
            f" ({where}); the paper's are milliseconds of a GeForce 8800 Ultra.", ""]
    text += left(results) if name == "table1_left" else right(results)
    folder = FOLDER / name
    folder.mkdir(exist_ok=True)
    (folder / "README.md").write_text("\n".join(text) + "\n")


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    main(pathlib.Path(sys.argv[1]))
