#!/usr/bin/env python3
"""Table 1 of Yang et al. 2012: its config from those of the figures, and its times from results.

usage: paper_table.py --write | --check    configs/papers/yang2012/table1.json
       paper_table.py --times RESULTS      configs/papers/yang2012/table1/README.md from out/.../table1
"""
import copy
import json
import pathlib
import re
import sys

FOLDER = pathlib.Path("configs/papers/yang2012")
# The rows of the paper's table, with its milliseconds (an NVIDIA GeForce GT 240). Its last row reads 11(b) again.
PAPER = {
    "fig04": {"a": 114.19, "b": 116.11, "c": 114.71, "d": 115.30},
    "fig05": {"a": 90.88, "b": 97.90, "c": 98.68, "d": 106.04},
    "fig06": {"a": 141.62, "b": 141.52},
    "fig09": {"b": 154.23, "c": 153.03, "d": 152.44, "e": 152.01, "f": 152.98},
    "fig10": {"b": 113.71, "c": 113.29, "d": 112.40},
    "fig08": {"a": 151.03, "b": 148.23, "c": 145.77, "d": 145.48, "e": 159.76, "f": 145.50},
    "fig11": {"b": 40.18, "c": 35.71, "d": 30.52},
}
KEYS = ["data", "optical_model", "estimator", "lights", "illumination", "camera", "clip", "image.size", "sampling.step"]
DEFAULTS = {"lights": [{"type": "head"}], "illumination": [], "clip": []}


def read(file):
    text = re.sub(r"^\s*//.*$|\s//[^\"\n]*$", "", file.read_text(), flags=re.M)
    return json.loads(text)


def put(config, path, value):
    *sections, key = path.split(".")
    for name in sections:
        config = config.setdefault(name, {})
    config[key] = value


def get(config, path):
    for name in path.split("."):
        if not isinstance(config, dict) or name not in config:
            return copy.deepcopy(DEFAULTS[path])
        config = config[name]
    return config


def panels(figure):
    """{panel: config without axes}"""
    config = read(FOLDER / f"{figure}.json")
    zipped = config["axes"]["permutation"]["zip"][0]
    found = {}
    for i, panel in enumerate(zipped["panel"]):
        case = copy.deepcopy(config)
        for key, values in zipped.items():
            put(case, key, values[i])
        found[panel] = case
    return found


def table():
    zipped = {"panel": [], **{key: [] for key in KEYS}}
    for figure, rows in PAPER.items():
        cases = panels(figure)
        for panel in rows:
            zipped["panel"].append(f"{figure}{panel}")
            for key in KEYS:
                zipped[key].append(get(cases[panel], key))
    lines = ["// Table 1: the times of all panels. Written by tools/paper_table.py from the configs of the figures; the paper's",
             "// order, sizes, and no acceleration.", "{",
             '  "sampling": { "type": "uniform", "unit": "voxel", "termination": 0, "skipping": false },',
             '  "axes": {', '    "permutation": {', '      "zip": [{']
    for k, (key, values) in enumerate(zipped.items()):
        lines.append(f'        "{key}": [')
        lines += [f"          {json.dumps(v)}" + ("," if i + 1 < len(values) else "") for i, v in enumerate(values)]
        lines.append("        ]" + ("," if k + 1 < len(zipped) else ""))
    lines += ["      }]", "    },",
              '    "variant": { "backend": [{ "type": "cpu" }, { "type": "vulkan" }, { "type": "opengl" }] }', "  }", "}"]
    return "\n".join(lines) + "\n"


def times(results):
    found, devices = {}, {}
    for file in pathlib.Path(results).glob("cases/*/case.json"):
        record = json.loads(file.read_text())
        spent = record["backend"].get("times", {}).get("march")
        if spent:
            backend = record["config"]["backend"]["type"]
            found[record["config"]["panel"], backend] = 1e3 * spent["median_s"]
            devices[backend] = record["backend"]["device"]
    lines = ["# Table 1: times", "",
             "Milliseconds of wall time of the march (uploads and compilation apart), one frame each, without empty-space skipping and",
             "early termination, from `./dev papers table1`; the first dispatch of a software GPU compiles again, about half a second. Ours are half a voxel per step (figure 11: one), the paper does not say its step. The paper's machine",
             "was an NVIDIA GeForce GT 240; ours, software GPUs included:", ""]
    lines += [f"* {backend}: {device}" for backend, device in sorted(devices.items())]
    lines += ["", "| panel | image | paper | cpu | vulkan | opengl |", "|---|---|---|---|---|---|"]
    for figure, rows in PAPER.items():
        cases = panels(figure)
        for panel, paper in rows.items():
            ours = [found.get((f"{figure}{panel}", b)) for b in ("cpu", "vulkan", "opengl")]
            size = get(cases[panel], "image.size")
            lines.append(f"| {int(figure[3:])}({panel}) | {size[0]}x{size[1]} | {paper:.2f} | " +
                         " | ".join("-" if t is None else f"{t:.0f}" for t in ours) + " |")
    return "\n".join(lines) + "\n"


if __name__ == "__main__":
    if sys.argv[1:] == ["--write"]:
        (FOLDER / "table1.json").write_text(table())
    elif sys.argv[1:] == ["--check"]:
        if (FOLDER / "table1.json").read_text() != table():
            sys.exit("table1.json is not what the figures' configs make it; tools/paper_table.py --write")
    elif len(sys.argv) == 3 and sys.argv[1] == "--times":
        (FOLDER / "table1").mkdir(exist_ok=True)
        (FOLDER / "table1/README.md").write_text(times(sys.argv[2]))
    else:
        sys.exit(__doc__)
