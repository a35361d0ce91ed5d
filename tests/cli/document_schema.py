# SPDX-License-Identifier: MIT
"""The lighting document's JSON Schema and the reader accept the same documents.

    document_schema.py LODESTAR SCHEMA FOLDER

FOLDER holds documents that both must accept. Then every member of a full document is replaced by values
of every type and size, and removed: schema and `lodestar check` must agree on each, but for the
differences listed below with their reasons. Exit status 77 where python3-jsonschema is missing.
"""
import copy
import json
import pathlib
import subprocess
import sys
import tempfile

try:
    import jsonschema
except ImportError:
    print("skipped: needs python3-jsonschema")
    sys.exit(77)

FULL = {
    "lodestar": 1,
    "author": {"name": "someone"},
    "environment": {"source": "park.hdr", "rotation": 30, "ev": -1.5},
    "lights": [
        {"name": "sky", "kind": "sky", "axis": [0, 2, 0], "add": True, "keys": [
            {"hour": 6, "tint": [1, 0.5, 0.25], "gradient": {
                "interpolation": "smooth", "space": "oklab", "stops": [
                    {"at": 90, "color": [0.1, 0.2, 0.5], "ev": 1},
                    {"at": 0, "color": [1, 0.9, 0.8]}]}}]},
        {"kind": "sun", "visibility": False,
         "path": {"latitude": 47.5, "dayOfYear": 172, "north": [0, 0, -1]}, "keys": [
             {"hour": 12, "axis": [0, 1, 0], "gradient": {
                 "interpolation": "constant", "stops": [
                     {"at": 0, "color": [1, 1, 1], "ev": 15.5},
                     {"at": 0.27, "color": [0, 0, 0]}]}}]}],
    "rsrm": {"exponents": [1, 40, 300]},
    "materials": {"gold": {"exponent": 64, "f0": [1, 0.8, 0.3]},
                  "#2": {"exponent": "mirror", "diffuse": [0, 0, 0], "specular": "mip",
                         "tolerance": 0.1}},
    "probes": [{"name": "hall", "position": [0, 1, 0], "update": {"every": 4},
                "capture": {"resolution": 64, "near": 0.1, "far": 50, "layers": 3},
                "influence": {"shape": "box", "center": [0, 0, 0], "size": [4, 3, 6], "blend": 0.5},
                "proxy": {"shape": "sphere", "radius": 4}, "priority": 2, "exterior": False,
                "tint": [1, 0.9, 0.8], "intensity": 1.5},
               {"name": "lift", "node": "Lift", "update": "always", "source": "lift.exr",
                "influence": {"size": [2, 2, 2], "blend": [1, 1, 0, 0, 0.5, 0.5]}}],
}

VALUES = [None, True, -1, 0, 0.5, 2, 91, 181, 367, 1e7, 2e7, 1e300, "", "mirror", "linear", "sun", "#1",
          [], [1], [0, 0, 0], [1, 2, 3], [1, 2, 3, 4], ["a", "b", "c"], [-1, 0, 0], {}, {"stops": []}]
REMOVED = object()

# (what the pointer ends in, the value, why the two differ)
NORTH = "a schema cannot ask for a part across +Y"
FAR = "nor that one member is greater than another"
HUGE = "nor that the squares of its parts are doubles"
DIFFERENCES = [
    ("/capture/near", 91, FAR), ("/capture/near", 181, FAR), ("/capture/near", 367, FAR),
    ("/capture/near", 1e7, FAR), ("/capture/near", 2e7, FAR),
    ("/rsrm/exponents/0", 91, FAR), ("/rsrm/exponents/0", 181, FAR), ("/rsrm/exponents/0", 367, FAR),
    ("/rsrm/exponents/1", 367, FAR), ("/rsrm/exponents/2", 2, FAR),
    ("/path/north", [0, 0, 0], NORTH),
    ("/path/north/2", 0, NORTH),
    ("/path/north/0", 1e300, HUGE),
    ("/path/north/2", 1e300, HUGE),
]


def pointers(value, path=()):
    """Every path of a document, the document's own left out."""
    if path:
        yield path
    if isinstance(value, dict):
        for key in value:
            yield from pointers(value[key], path + (key,))
    elif isinstance(value, list):
        for index in range(len(value)):
            yield from pointers(value[index], path + (index,))


def changed(path, value):
    document = copy.deepcopy(FULL)
    place = document
    for step in path[:-1]:
        place = place[step]
    if value is REMOVED:
        del place[path[-1]]
    else:
        place[path[-1]] = value
    return document


def reader_refuses(lodestar, files):
    """The files that `lodestar check` refuses, with its words."""
    refused = {}
    for start in range(0, len(files), 400):
        part = files[start:start + 400]
        run = subprocess.run([lodestar, "check", *part], capture_output=True, text=True, check=False)
        if run.returncode not in (0, 3):
            sys.exit(f"check ended with status {run.returncode}: {run.stderr}")
        answers = json.loads(run.stdout)
        answers = answers if isinstance(answers, list) else [answers]
        if len(answers) != len(part):
            sys.exit(f"check answered {len(answers)} times for {len(part)} files")
        for answer in answers:
            if "error" in answer:
                refused[answer["file"]] = f'{answer["error"]} ({answer.get("where", "")})'
    return refused


def main(lodestar, schema_path, folder):
    schema = json.loads(pathlib.Path(schema_path).read_text())
    jsonschema.Draft202012Validator.check_schema(schema)
    validator = jsonschema.Draft202012Validator(schema)
    failures = 0
    used = set()
    with tempfile.TemporaryDirectory() as temporary:
        cases = {}
        samples = sorted(pathlib.Path(folder).glob("*.lodestar.json"))
        for sample in samples:
            cases[str(sample)] = (str(sample), json.loads(sample.read_text()), None)
        number = 0
        for path in [()] + list(pointers(FULL)):
            for value in VALUES + [REMOVED] if path else [None]:
                document = changed(path, value) if path else FULL
                name = f"{temporary}/{number}.lodestar.json"
                number += 1
                pathlib.Path(name).write_text(json.dumps(document))
                cases[name] = ("/" + "/".join(map(str, path)), document, value)
        refused = reader_refuses(lodestar, list(cases))
        valid = 0
        for name, (where, document, value) in cases.items():
            by_schema = next(validator.iter_errors(document), None)
            valid += by_schema is None
            if (by_schema is None) == (name not in refused):
                continue
            known = [i for i, (end, given, _) in enumerate(DIFFERENCES)
                     if where.endswith(end) and given == value and type(given) is type(value)]
            used.update(known)
            if not known:
                failures += 1
                print(f"{where} = {'(removed)' if value is REMOVED else json.dumps(value)}: the schema "
                      f"{'accepts it' if by_schema is None else 'says: ' + by_schema.message}; the reader "
                      f"{'says: ' + refused[name] if name in refused else 'accepts it'}")
    for index, (end, given, why) in enumerate(DIFFERENCES):
        if index not in used:
            failures += 1
            print(f"listed, but not met: {end} = {json.dumps(given)}, {why}")
    if not samples or valid < 50 or len(cases) - valid < 500:
        failures += 1
        print("too few documents were compared")
    print(f"{len(cases)} documents compared, {valid} valid; {failures} failures")
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
