# SPDX-License-Identifier: MIT
"""What composing a changed sky behind a light probe's captured geometry costs against capturing it again.

    tests/bench/relight.py LODESTAR SCENE DOCUMENT [PROBE]

SCENE and DOCUMENT are the courtyard's (lodestar-make-assets; samples/skies/lift.lodestar.json). The sky alone
lights it, so that no shadow map is waited for; the hour goes on from frame to frame and the threshold has
the probe captured again now and then. Medians over frames of one run of what `--stats` calls "probes".
"""
import json
import pathlib
import statistics
import subprocess
import sys
import tempfile

lodestar, scene, document = sys.argv[1:4]
name = sys.argv[4] if len(sys.argv) > 4 else "Courtyard"
lighting = json.loads(pathlib.Path(document).read_text())
lighting["lights"] = [light for light in lighting["lights"] if light["kind"] == "sky"]
lighting["probes"] = [probe for probe in lighting["probes"] if probe["name"] == name]
with tempfile.TemporaryDirectory() as folder:
    folder = pathlib.Path(folder)
    (folder / "sky.lodestar.json").write_text(json.dumps(lighting))
    subprocess.run([lodestar, "render", scene, "--lighting", folder / "sky.lodestar.json", "--camera", "courtyard",
                    "--size", "160x100", "--hour", "16", "--frames", "80", "--fps", "10", "--hours-per-second", "1",
                    "-o", folder / "x.png", "--stats", folder / "stats.json"], check=True)
    frames = json.loads((folder / "stats.json").read_text())["frames"][3:]
composed, captured = [], []
for frame in frames:
    ran = {e["effect"] for e in frame["effects"] if e["decision"] == "run"}
    if frame["counters"]["probe_faces"] == 6:
        captured.append(frame["times_ms"]["probes"])
    elif frame["counters"]["probe_faces"] == 0 and "probe-compose" in ran:
        composed.append(frame["times_ms"]["probes"])
a, b = statistics.median(captured), statistics.median(composed)
print(f"captured and composed {a:.2f} ms ({len(captured)} frames), composed alone {b:.2f} ms ({len(composed)}): "
      f"{a / b:.1f}")
