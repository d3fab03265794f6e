#!/usr/bin/env python3
"""Every config and example is valid against `dvrlab schema`; wrong ones are refused by the schema and by dvrlab alike.

  schema_test.py DVRLAB SOURCE_FOLDER TEMPLATE_PLUGINS
"""
import copy
import json
import re
import subprocess
import sys
import tempfile
from pathlib import Path

import jsonschema

dvrlab, source, templates = sys.argv[1], Path(sys.argv[2]), sys.argv[3]


def read(path):
    """JSON with // and block comments."""
    text = re.sub(r'("(?:\\.|[^"\\])*")|//[^\n]*|/\*.*?\*/', lambda m: m.group(1) or "", path.read_text(), flags=re.S)
    return json.loads(text)


BASE = {
    "data": {"type": "procedural", "field": "sphere", "size": [8, 8, 8]},
    "optical_model": {"type": "absorption_emission", "extinction": [[0, 0], [1, 2]]},
    "estimator": {"type": "direct"},
    "camera": {"type": "perspective", "position": [1, 2, 3]},
    "metrics": ["psnr"],
}
# What is changed (key path -> value; None takes the key away).
RIGHT = {
    "the base itself": {},
    "$schema": {"$schema": "config.schema.json"},
    "sections by default": {"sampling": {"step": 0.5}, "backend": {"threads": 1}},
    "a metric as a section": {"metrics": [{"type": "psnr", "peak": 2}]},
    "key paths": {"axes": {"permutation": {"sampling.step": {"log2": [2, 0.5]}, "data.radius": [0.5, 1]},
                           "variant": {"backend": [{"type": "cpu"}], "lights": [[{"type": "head"}]]}}},
    "a key that an axis brings": {"camera": {"type": "perspective"},
                                  "axes": {"permutation": {"camera.position": [[1, 2, 3], [3, 2, 1]]}}},
    "a section that an axis brings": {"estimator": None, "axes": {"permutation": {"estimator": [{"type": "direct"}]}}},
    "references and expectations": {"reference": {"fine": {"sampling.step": 0.1, "camera": {"fov_deg": 20}}},
                                    "expect": [{"metric": "psnr", "against": "fine", "at_least": 1,
                                                "where": {"sampling.step": 1}}]},
    "keys that vary together": {"axes": {"permutation": {"zip": [{"sampling.step": [1, 2], "seed": [1, 2]}]}}},
    "whole numbers of a range": {"image": {"size": [8, 8]}, "axes": {"permutation": {"image.size[0]": {"lin": [4, 8, 3]}}}},
    "four lights": {"lights": [{"type": "head"}] * 4},
    "null nodes": {"optical_model.opacity": None, "optical_model.emission": "null"},
}
WRONG = {
    "unknown section": {"kamera": {}},
    "unknown key in a section": {"camera.fov": 30},
    "unknown key of a plugin": {"estimator.table_size": 5},
    "key of another type": {"camera.height": 2},
    "unknown type": {"estimator.type": "dirct"},
    "missing type": {"estimator": {}},
    "missing required key": {"camera": {"type": "perspective"}},
    "number out of range": {"camera.fov_deg": 180},
    "number as text": {"camera.fov_deg": "30"},
    "whole number with a fraction": {"seed": 1.5},
    "unknown word of a choice": {"camera.frame": "object"},
    "two numbers instead of three": {"camera.position": [1, 2]},
    "negative colour": {"lights": [{"type": "head", "color": [-1, 0, 0]}]},
    "unknown light": {"lights": [{"type": "sun"}]},
    "a section instead of a list": {"lights": {"type": "head"}},
    "nodes with four and two numbers": {"optical_model.extinction": [[0, 0], [1, 2, 3, 4]]},
    "key that the choice does not read": {"data.alpha": 0.5},
    "key that the default choice does not read": {"data": {"type": "procedural", "radius": 1}},
    "image of no size": {"image": {"size": [0, 8]}},
    "structure of another shape": {"data.bounds": [[0, 0], [1, 1]]},
    "unknown role of an axis": {"axes": {"permutations": {"seed": [1, 2]}}},
    "unknown key of an axis": {"axes": {"permutation": {"sampling.stepp": [1, 2]}}},
    "axis without values": {"axes": {"permutation": {"seed": []}}},
    "illegal value of an axis": {"axes": {"permutation": {"sampling.step": [1, -2]}}},
    "unknown key of a zip": {"axes": {"permutation": {"zip": [{"sampling.stepp": [1, 2]}]}}},
    "empty zip": {"axes": {"permutation": {"zip": []}}},
    "zip of nothing": {"axes": {"permutation": {"zip": [{}]}}},
    "seventeen lights": {"lights": [{"type": "head"}] * 17},
    "range of one value": {"axes": {"permutation": {"sampling.step": {"lin": [1, 2, 1]}}}},
    "range of half a value": {"axes": {"permutation": {"sampling.step": {"lin": [1, 2, 2.5]}}}},
    "zip that is no list": {"axes": {"permutation": {"zip": {"seed": [1, 2]}}}},
    "unknown range": {"axes": {"permutation": {"sampling.step": {"log3": [1, 2]}}}},
    "unknown key of a reference": {"reference": {"fine": {"sampling.stepp": 1}}},
    "metrics of a reference": {"reference": {"fine": {"metrics": []}}},
    "a reference's name": {"reference": {"variant": {"sampling.step": 1}}},
    "expectation without bound": {"reference": {"fine": {"sampling.step": 0.5}},
                                  "expect": [{"metric": "psnr", "against": "fine"}]},
    "expectation with two bounds": {"reference": {"fine": {"sampling.step": 0.5}},
                                    "expect": [{"metric": "psnr", "against": "fine", "at_least": 1, "at_most": 2}]},
    "unknown metric": {"metrics": ["psnrr"]},
    "metric with an unknown key": {"metrics": [{"type": "psnr", "peek": 1}]},
    "include that is no file": {"include": 5},
}


def changed(changes):
    config = copy.deepcopy(BASE)
    for path, value in changes.items():
        *sections, key = path.split(".")
        place = config
        for section in sections:
            place = place[section]
        if value is None:
            place.pop(key, None)
        else:
            place[key] = None if value == "null" else value
    return config


def program_accepts(config, folder):
    file = folder / "config.json"
    file.write_text(json.dumps(config))
    done = subprocess.run([dvrlab, "validate", file], capture_output=True, text=True)
    if done.returncode not in (0, 2):
        sys.exit(f"dvrlab validate: exit code {done.returncode}: {done.stderr}")
    return done.returncode == 0


def main(folder):
    schema = json.loads(subprocess.run([dvrlab, "--plugin-path", templates, "schema"], capture_output=True, check=True).stdout)
    jsonschema.Draft7Validator.check_schema(schema)
    validator = jsonschema.Draft7Validator(schema)
    bad = []
    files = sorted([*(source / "configs").rglob("*.json"), *(source / "plugins").rglob("*.example.json"),
                    *(source / "backends").rglob("*.example.json"), *(source / "bench").rglob("configs/*.json")])
    for file in files:
        for error in validator.iter_errors(read(file)):
            bad.append(f"{file.relative_to(source)}: {error.json_path}: {error.message[:200]}")
    for what, changes in RIGHT.items():
        config = changed(changes)
        bad += [f"{what}: refused by the schema: {e.json_path}: {e.message[:200]}" for e in validator.iter_errors(config)]
        if not program_accepts(config, folder):
            bad.append(f"{what}: refused by dvrlab")
    for what, changes in WRONG.items():
        config = changed(changes)
        if validator.is_valid(config):
            bad.append(f"{what}: not refused by the schema")
        if program_accepts(config, folder):
            bad.append(f"{what}: not refused by dvrlab")
    print("\n".join(bad))
    print(f"schema: {len(files)} files, {len(RIGHT)} right and {len(WRONG)} wrong configs, {len(bad)} disagreements")
    return 1 if bad or len(files) < 20 else 0


if __name__ == "__main__":
    with tempfile.TemporaryDirectory() as temporary:
        sys.exit(main(Path(temporary)))
