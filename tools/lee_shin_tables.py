#!/usr/bin/env python3
"""Tables 1 to 4 of Lee and Shin 2013.

usage: lee_shin_tables.py --write | --check           table3.json, table3_views.json and table4.json from the figures' configs
       lee_shin_tables.py --table1 | --table2 DVRLAB  their READMEs, from `dvrlab table`
       lee_shin_tables.py --table3 | --table3_views | --table4 RESULTS  their READMEs, from results
"""
import copy
import csv
import json
import math
import pathlib
import re
import subprocess
import sys

FOLDER = pathlib.Path("configs/papers/lee_shin2013")
MODEL = ["data", "optical_model", "illumination", "camera", "clip"]
# Rows of table 3: the figure whose data and transfer function they have, the paper's name and its average.
ROWS = {
    "sphere": ("fig05", "sphere (figure 5)", 43.95),
    "head": ("fig06", "head (figure 6)", 50.38),
    "skin": ("fig07", "chest (figure 7)", 45.76),
    "function": ("fig08", "function (figure 8)", 65.00),
    "nonlinear": ("fig09", "ribs (figure 9)", 31.53),
    "soft": ("fig06", "none: 40 dB are guaranteed", None),
    "deep": ("fig05", "none: the documented failure", None),
}
SMALL = {"sphere", "function", "deep"}  # 8 bit: 256 entries


def read(figure):
    text = (FOLDER / f"{figure}.json").read_text()
    return json.loads(re.sub(r"^\s*//.*$|\s//[^\"\n]*$", "", text, flags=re.M))


def scene(row):
    config = read(ROWS[row][0])
    part = {key: copy.deepcopy(config.get(key, [])) for key in MODEL}
    if row == "soft":  # depth M < 0.084 in a voxel, colours within 0.85: (1 + M) M 0.85 < 0.08
        part["optical_model"]["opacity"] = [[100, 0], [400, 0.08], [1400, 0.08], [1600, 0]]
        del part["optical_model"]["interpolation"]
    if row == "deep":  # layers that lie in one step, up to 6 deep, whose front and back differ in colour
        top = 1 - math.exp(-16)
        part["optical_model"]["opacity"] = [[27, 0], [30, top], [33, 0], [97, 0], [100, top], [103, 0]]
        part["optical_model"]["color"] = [[0, 0.1, 0.2, 1], [30, 0.1, 0.2, 1], [30, 1, 0.8, 0.1], [70, 1, 0.8, 0.1],
                                          [70, 0.9, 0.1, 0.1], [100, 0.9, 0.1, 0.1], [100, 0.1, 0.9, 0.3], [255, 0.1, 0.9, 0.3]]
    return part


def rows_text(keys, values):
    lines = []
    for i, key in enumerate(keys):
        lines.append(f'        "{key}": [')
        lines += ["          " + json.dumps(v) + ("," if k + 1 < len(values[key]) else "") for k, v in enumerate(values[key])]
        lines.append("        ]" + ("," if i + 1 < len(keys) else ""))
    return lines


def series_of(row):
    return {"type": "power_series", "table_size": 256 if row in SMALL else 1024 if row == "nonlinear" else 4096,
            "shading": "nonlinear" if row == "nonlinear" else "constant"}


def columns(rows, keys):
    values = {"panel": list(rows), **{key: [] for key in keys + ["estimator"]}}
    for row in rows:
        part = scene(row)
        for key in keys:
            values[key].append(part[key])
        values["estimator"].append(series_of(row))
    return values


def at_least(row, against, bound, more=""):
    return f'    {{ "metric": "psnr.mean_db", "against": "{against}", "where": {{ "panel": "{row}" }}, {more}"at_least": {bound} }}'


def table3():
    values = columns(ROWS, MODEL)
    lines = ["// Table 3: PSNR of the power series of order 1 against PI_2D, 800 x 800. The scenes of the figures, and one that must fail: layers",
             "// that lie in one step, up to 6 deep, and change their colour in the middle. Written by tools/lee_shin_tables.py.", "{",
             '  "sampling": { "type": "uniform", "step": 1, "unit": "voxel", "termination": 0.001 },',
             '  "image": { "size": [800, 800] },', '  "axes": {', '    "permutation": {', '      "zip": [{']
    lines += rows_text(list(values), values)
    lines += ["      }]", "    }", "  },",
              '  "reference": {',
              '    "PI_2D": { "estimator.type": "preintegrated", "estimator.lookup": "plain" },',
              '    "exact": { "estimator": { "type": "exact", "shading": "constant" } }', "  },",
              '  "metrics": ["psnr"],', '  "expect": [',
              "    // soft: the bound of docs/math G; the others: what the paper says of its own",
              at_least("soft", "exact", 41.6) + ",", *[at_least(row, "PI_2D", 40) + "," for row in ["soft", "sphere", "head", "skin", "function"]],
              at_least("nonlinear", "PI_2D", 35) + ",",
              '    { "metric": "psnr.mean_db", "against": "exact", "where": { "panel": "deep" }, "at_most": 32 }', "  ]", "}"]
    return "\n".join(lines) + "\n"


VIEW_ROWS = ["sphere", "head", "skin", "nonlinear", "soft"]


def table3_views():
    keys = ["data", "optical_model", "illumination", "clip"]
    values = columns(VIEW_ROWS, keys)
    over = lambda take: f'"over": "views", "take": "{take}", '
    lines = ["// Table 3 from 360 directions: mean and worst PSNR of the power series of order 1 against PI_2D, 400 x 400. Written by",
             "// tools/lee_shin_tables.py.", "{", '  "camera": { "type": "orbit", "views": 360, "distance": 4, "fov_deg": 27 },',
             '  "sampling": { "type": "uniform", "step": 1, "unit": "voxel", "termination": 0.001 },',
             '  "image": { "size": [400, 400] },', '  "axes": {', '    "permutation": {', '      "zip": [{']
    lines += rows_text(list(values), values)
    lines += ["      }]", "    }", "  },",
              '  "reference": { "PI_2D": { "estimator.type": "preintegrated", "estimator.lookup": "plain" } },',
              '  "metrics": ["psnr"],', '  "expect": [', at_least("soft", "PI_2D", 41.6, over("worst")) + ",",
              *[at_least(row, "PI_2D", 40, over("mean")) + "," for row in ["sphere", "head", "skin"]],
              at_least("nonlinear", "PI_2D", 35, over("mean")), "  ]", "}"]
    return "\n".join(lines) + "\n"


METHODS = {
    "PC": {"type": "direct"},
    "PI_1D": {"type": "kye_1d", "shading": "constant", "opaque_prediction": "off"},
    "PI_2D": {"type": "preintegrated", "lookup": "plain", "shading": "constant"},
    "PI_PS": {"type": "power_series", "shading": "constant"},
    "PI_PS without prediction": {"type": "power_series", "shading": "constant", "opaque_prediction": "off"},
    "NLPI_2D": {"type": "preintegrated", "lookup": "plain", "shading": "nonlinear"},
    "NLPI_PS": {"type": "power_series", "shading": "nonlinear"},
}
LINEAR = [m for m in METHODS if not m.startswith("NL")]
SPEED_ROWS = {"sphere": LINEAR, "head": LINEAR, "skin": LINEAR, "nonlinear": ["NLPI_2D", "NLPI_PS"]}
# Frames per second (NVIDIA GTX 680); nonlinear: the paper's ribs.
PAPER_SPEED = {"sphere": {"PC": 300.65, "PI_1D": 233.44, "PI_2D": 277.43, "PI_PS": 290.28},
               "head": {"PC": 192.66, "PI_1D": 186.84, "PI_2D": 158.09, "PI_PS": 185.53, "PI_PS without prediction": 202.11},
               "skin": {"PC": 34.99, "PI_1D": 21.23, "PI_2D": 51.91, "PI_PS": 61.54},
               "nonlinear": {"NLPI_2D": 38.08, "NLPI_PS": 19.43}}


def table4():
    keys = ["panel", "data", "optical_model", "illumination", "clip", "estimator"]
    values = {key: [] for key in keys}
    for row, methods in SPEED_ROWS.items():
        part = scene(row)
        for name in methods:
            estimator = dict(METHODS[name])
            if estimator["type"] != "direct":
                estimator["table_size"] = series_of(row)["table_size"]
            values["panel"].append(f"{row}, {name}")
            for key in ["data", "optical_model", "illumination", "clip"]:
                values[key].append(part[key])
            values["estimator"].append(estimator)
    lines = ["// Table 4: times from 360 directions, 800 x 800, with early termination and empty-space skipping as the paper has them. Written",
             "// by tools/lee_shin_tables.py.", "{",
             '  "camera": { "type": "orbit", "views": 360, "distance": 4, "fov_deg": 27 },',
             '  "sampling": { "type": "uniform", "step": 1, "unit": "voxel", "termination": 0.001 },',
             '  "image": { "size": [800, 800] },', '  "axes": {', '    "permutation": {', '      "zip": [{']
    lines += rows_text(keys, values)
    lines += ["      }]", "    }", "  }", "}"]
    return "\n".join(lines) + "\n"


def studies(dvrlab, name, *arguments):
    run = subprocess.run([dvrlab, "table", FOLDER / f"{name}.json", "--json", "--out", "out/papers/lee_shin2013", *arguments],
                         check=True, stdout=subprocess.PIPE)
    return json.loads(run.stdout)


def size_text(n):
    return f"{n / 1024:.4g} KiB" if n < 1 << 20 else f"{n / (1 << 20):.4g} MiB"


def by_method(list_of):
    """{method: {entries: study}}"""
    found = {}
    for s in list_of:
        method, entries = s["choices"]["panel"].rsplit("_", 1)  # labels have no spaces
        found.setdefault(re.sub(r"PS_(\d)_", r"PS(\1)", method).replace(",_", ", "), {})[int(entries)] = s
    return found


PAPER_SIZE = {"PI_2D": (1 << 20, 256 << 20), "PI_1D": (4 << 10, 64 << 10), "PI_PS(1)": (4 << 10, 64 << 10), "PI_PS(3), fp64": (24 << 10, 384 << 10)}


def published_size(method, n):
    """Bytes of RGBA sums as the paper keeps them."""
    if method.startswith("PI_2D"):
        return 16 * n * n
    series = re.fullmatch(r"PI_PS\((\d)\)(, fp64)?", method)
    if series:
        return int(series[1]) * n * (32 if series[2] else 16)
    return 16 * n


def write_table1(dvrlab):
    found = by_method(studies(dvrlab, "table1", "--points", "16"))
    lines = ["# Table 1: sizes of the tables", "",
             "Unshaded RGBA with grey extinction, from `./dev papers lee_shin2013/table1` (`dvrlab table`); the paper's beside ours. The paper's sizes are",
             "without its prediction table P, ours too: it belongs to the framework and has four numbers per entry of the transfer function",
             "(4 KiB and 64 KiB at 256 and 4096 entries). Published precision: what the numbers that the paper keeps take, n^2, n or N n times four of",
             "4 or 8 bytes.", "",
             "| method | 256 entries, paper | published precision | ours | 4096 entries, paper | published precision | ours |", "|---|---|---|---|---|---|---|"]
    for method, sizes in found.items():
        paper = PAPER_SIZE.get(method)
        cells = [method]
        for k, n in enumerate((256, 4096)):
            published = published_size(method, n)
            if paper and published != paper[k]:
                sys.exit(f"table 1: {method} with {n} entries: {published} bytes at the published precision, the paper has {paper[k]}")
            cells += [size_text(paper[k]) if paper else "-", size_text(published) if published else "-",
                      size_text(sizes[n]["bytes"]) if "bytes" in sizes.get(n, {}) else "-"]
        lines.append("| " + " | ".join(cells) + " |")
    lines += ["",
              "Why ours differ. PI_2D: n (n + 1) / 2 entries in each of two directions, and no others, 16 bytes each as in the paper; the sums that segments of",
              "another length need come on top. PI_1D and PI_PS(1): a sum is kept as two floats, with the mean in the bin: 48 bytes an entry where the paper",
              "has 16, so that a slab of a few bins keeps its digits. PI_PS(3): moments on log2 n levels, because differences of sums of powers lose",
              "what fp32 has and most of what fp64 has; 4 bins of 4096 would have an error of 1.3 of their colour in fp32 and 6e-9 in fp64, with levels",
              "both are at rounding.", ""]
    (FOLDER / "table1").mkdir(exist_ok=True)
    (FOLDER / "table1/README.md").write_text("\n".join(lines))


PAPER_TIME = {"PI_2D": (0.126, 1569), "PI_1D": (0.0039, 0.0501), "PI_PS(1)": (0.0186, 0.2211), "PI_PS(3), fp64": (0.0386, 0.5172)}


def write_table2(dvrlab):
    found = by_method(studies(dvrlab, "table2", "--points", "8", "--repeat", "21"))
    times = {m: {n: 1e3 * s["build_s"] for n, s in sizes.items() if "build_s" in s} for m, sizes in found.items()}
    ratio = times["PI_2D"][4096] / times["PI_PS(1)"][4096]
    lines = ["# Table 2: times of the tables", "",
             "Milliseconds, medians of 21 builds from the medium to what a kernel reads, from `./dev papers lee_shin2013/table2` (`dvrlab table`); unshaded RGBA.",
             "PI_2D uses all processors, the others one. The paper's machine was an Intel i5. A study builds into memory that is new to the process, once per",
             "case; `./dev bench tables` builds again and again in the same memory and takes the least time, as an editor does (bench/README): PI_2D takes",
             f"1500 times as long as PI_PS(1) at 4096 entries there (54 and 0.036 ms), and {ratio:.0f} times here.", "",
             "| method | 256, paper | ours | 4096, paper | ours | 65536, ours | exponent 256 - 4096, paper | ours | PI_2D / method at 4096, paper | ours |",
             "|---|---|---|---|---|---|---|---|---|---|"]
    for method, t in times.items():
        paper = PAPER_TIME.get(method)
        cell = lambda x: "-" if x is None else f"{x:.3g}"
        growth = lambda a, b: None if not a or not b else math.log(b / a) / math.log(16)
        a, b = paper or (None, None)
        lines.append("| " + " | ".join([
            method, cell(a), cell(t.get(256)), cell(b), cell(t.get(4096)), cell(t.get(65536)), cell(growth(a, b)),
            cell(growth(t.get(256), t.get(4096))), cell(1569 / b if b else None),
            cell(times["PI_2D"][4096] / t[4096] if 4096 in t else None)]) + " |")
    lines.append("")
    (FOLDER / "table2").mkdir(exist_ok=True)
    (FOLDER / "table2/README.md").write_text("\n".join(lines))


def results_of(folder):
    with open(pathlib.Path(folder) / "results.csv", newline="") as f:
        return [row for row in csv.DictReader(f) if row["role"] == "case"]


def write_table3(results):
    found = {row["panel"]: row for row in results_of(results)}
    number = lambda row, key: f"{float(row[key]):.2f}" if row.get(key) else "-"
    lines = ["# Table 3: PSNR against PI_2D", "",
             "The power series of order 1 against full pre-integration with the plain look-up, in dB, 800 x 800, from `./dev papers lee_shin2013/table3`.",
             "The paper's data but for the sphere and the function are not public: its averages stand beside ours to compare with, not to be met.", "",
             "| scene | red | green | blue | mean of channels | pooled | the paper's mean | against exact, pooled |", "|---|---|---|---|---|---|---|---|"]
    for panel, (_, name, paper) in ROWS.items():
        row = found.get(panel, {})
        cells = [number(row, f"{key} against PI_2D") for key in ["psnr.r", "psnr.g", "psnr.b", "psnr.mean_db", "psnr"]]
        lines.append(f"| {panel} | " + " | ".join(cells) + f" | {name} {paper if paper else ''} | {number(row, 'psnr against exact')} |")
    lines += ["", "The last column of `nonlinear` compares it with an exact integral under constant light, so it holds the difference of the two kinds of light.", "",
              "`soft` lies where docs/math G guarantees the result: (1 + M) M osc / 8 < 0.01 for a depth M in a voxel and colours that differ by osc.",
              "The other scenes are far deeper in a voxel; that their colours hardly change there is what saves them.", "",
              "`deep` is the documented failure (docs/math G): as soon as a segment is deeper than about 2 and its colour changes inside, order 1 mixes the colours of the",
              "layer's front and back. Higher orders do not help there; short segments do, and `exact` and `preintegrated` have the order right.", ""]
    (FOLDER / "table3").mkdir(exist_ok=True)
    (FOLDER / "table3/README.md").write_text("\n".join(lines))


def write_table3_views(results):
    with open(pathlib.Path(results) / "views.csv", newline="") as f:
        rows = [r for r in csv.DictReader(f) if r["metric"] == "psnr.mean_db"]
    lines = ["# Table 3 from 360 directions", "",
             "PSNR (mean of the channels, dB) of the power series of order 1 against PI_2D over the views of an orbit, 400 x 400, from",
             "`./dev papers lee_shin2013/table3_views`.", "",
             "| scene | views | mean | worst | in view | the paper's mean |", "|---|---|---|---|---|---|"]
    for panel in VIEW_ROWS:
        for r in rows:
            if r["panel"] == panel:
                lines.append(f"| {panel} | {r['views']} | {float(r['mean']):.2f} | {float(r['worst']):.2f} | {r['worst_view']} | "
                             f"{ROWS[panel][1]} {ROWS[panel][2] or ''} |")
    lines.append("")
    (FOLDER / "table3_views").mkdir(exist_ok=True)
    (FOLDER / "table3_views/README.md").write_text("\n".join(lines))


def write_table4(results):
    rows = results_of(results)
    lines = ["# Table 4: speed", "",
             f"Milliseconds of the march per frame over the views of an orbit (mean, worst), 800 x 800, with early termination and empty-space skipping, from",
             "`./dev papers lee_shin2013/table4`; samples and table fetches are million per frame (mean). The paper: frames per second on an NVIDIA GTX 680.", "",
             "| scene | method | views | mean ms | worst ms | samples | skipped | table fetches | rays ended early | relative to the 2-D table | the paper, fps | relative |",
             "|---|---|---|---|---|---|---|---|---|---|---|---|"]
    for scene_name, methods in SPEED_ROWS.items():
        base_method = "NLPI_2D" if scene_name == "nonlinear" else "PI_2D"
        base = None
        table = []
        for method in methods:
            mine = [r for r in rows if r["panel"] == f"{scene_name}, {method}".replace(" ", "_") and r.get("march_s")]
            if not mine:
                continue
            t = [1e3 * float(r["march_s"]) for r in mine]
            mean = lambda key: sum(float(r[key]) for r in mine) / len(mine)
            if method == base_method:
                base = sum(t) / len(t)
            table.append((method, len(mine), sum(t) / len(t), max(t), mean("samples") / 1e6, mean("skipped") / 1e6,
                          mean("table_fetches") / 1e6, mean("terminated")))
        for method, views, average, worst, samples, skipped, fetches, ended in table:
            paper = PAPER_SPEED[scene_name].get(method)
            relative = f"{PAPER_SPEED[scene_name][base_method] / paper:.2f}" if paper else "-"
            lines.append(f"| {scene_name} | {method} | {views} | {average:.0f} | {worst:.0f} | {samples:.2f} | {skipped:.2f} | {fetches:.1f} | {ended:.0f} | "
                         f"{average / base:.2f} | {paper if paper else '-'} | {relative} |")
    lines.append("")
    (FOLDER / "table4").mkdir(exist_ok=True)
    (FOLDER / "table4/README.md").write_text("\n".join(lines))


def main(arguments):
    texts = {"table3.json": table3, "table3_views.json": table3_views, "table4.json": table4}
    if arguments == ["--write"]:
        for name, text in texts.items():
            (FOLDER / name).write_text(text())
    elif arguments == ["--check"]:
        for name, text in texts.items():
            if (FOLDER / name).read_text() != text():
                sys.exit(f"{name} is not what the figures' configs make it; tools/lee_shin_tables.py --write")
    elif len(arguments) == 2 and arguments[0] in ("--table1", "--table2", "--table3", "--table3_views", "--table4"):
        globals()["write_" + arguments[0][2:]](arguments[1])
    else:
        sys.exit(__doc__)


if __name__ == "__main__":
    main(sys.argv[1:])
