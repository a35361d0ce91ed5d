# SPDX-License-Identifier: MIT
"""The samples' programs, each once and small: assets are made, accepted and show something.

    samples.py BUILD-FOLDER SKIES-FOLDER
"""
import json
import pathlib
import subprocess
import sys
import tempfile


def run(*arguments):
    done = subprocess.run([str(a) for a in arguments], capture_output=True, text=True, check=False)
    if done.returncode != 0:
        sys.exit(f"{' '.join(map(str, arguments))}: status {done.returncode}: {done.stderr}")
    return done.stdout


def main(build, skies):
    build = pathlib.Path(build)
    lodestar = build / "lodestar"
    with tempfile.TemporaryDirectory() as temporary:
        folder = pathlib.Path(temporary)
        run(build / "lodestar-make-assets", folder)
        assets = sorted(folder.glob("*.gltf")) + sorted(folder.glob("*.exr"))
        answers = json.loads(run(lodestar, "check", *assets))
        if len(answers) != len(assets) or len(assets) < 10:
            sys.exit(f"{len(assets)} assets were made, {len(answers)} checked")
        for answer in answers:
            if "error" in answer or answer["warnings"]:
                sys.exit(f"{answer['file']}: {answer.get('error', answer['warnings'])}")
        pictures = []
        for scene in folder.glob("*.gltf"):
            picture = folder / f"{scene.stem}-picture.exr"
            run(lodestar, "render", scene, "-o", picture, "--size", "48x32", "--samples", "1",
                "--environment", folder / "faces.exr", "--environment-width", "64")
            pictures.append(picture)
        document = pathlib.Path(skies) / "clear.lodestar.json"
        run(build / "lodestar-day", folder / "terrace.gltf", folder, "48x32", "terrace", "9,18.5", document)
        pictures += [folder / "clear-9.png", folder / "clear-18.5.png"]
        run(lodestar, "bake", document, "--light", "sun", "--exponents", "1,64", "-o", folder / "sun.exr")
        run(build / "lodestar-compose", "-o", folder / "sheet.png", "--title", "Sheet", "--row", "a row",
            folder / "clear-9.png", "--inset", folder / "sun.exr", f"{folder / 'clear-18.5.png'}::evening")
        pictures.append(folder / "sheet.png")
        for answer in json.loads(run(lodestar, "check", *pictures)):
            if answer["nonFinite"] or answer["max"] <= 0.05 or answer["max"] - answer["min"] <= 0.02:
                sys.exit(f"{answer['file']} shows nothing: {answer}")
        print(f"{len(assets)} assets accepted, {len(pictures)} pictures show something")
    return 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
