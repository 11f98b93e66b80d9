"""Import and decode of pictures against a straightforward Pillow + numpy loop, in turn.

usage: python3 benches/peers/decode.py SOURCE MAP.toml 'IMAGES/*.png'

Ours: `taceva import` (read, verify, copy, digest, force to disk), and `taceva check --only TAC004` (decode every frame).
Theirs: one loop that opens each picture and turns it into an array.
"""
import glob
import pathlib
import shutil
import sys
import tempfile

from common import in_turn, need, report, run


def main(source, map_file, pattern):
    need("numpy", "PIL")
    import numpy
    from PIL import Image

    files = sorted(glob.glob(pattern))
    if not files:
        sys.exit(f"no file matches {pattern}")
    folder = pathlib.Path(tempfile.mkdtemp())
    target = folder / "dataset"
    decoded = folder / "decoded"
    run("import", source, "--map", map_file, "--out", decoded, "--quiet")

    def pillow():
        for file in files:
            numpy.asarray(Image.open(file))

    def ours_import():
        shutil.rmtree(target, ignore_errors=True)
        run("import", source, "--map", map_file, "--out", target, "--quiet")

    def ours_decode():
        run("check", decoded, "--only", "TAC004", "--quiet")

    times, machine = in_turn(5, **{"pillow + numpy loop": pillow, "taceva import": ours_import, "taceva decode": ours_decode})
    print(f"{len(files)} pictures")
    report(times, "taceva import", machine)
    report({name: times[name] for name in ("pillow + numpy loop", "taceva decode")}, "taceva decode", machine)
    shutil.rmtree(folder)


if __name__ == "__main__":
    if len(sys.argv) != 4:
        sys.exit(__doc__)
    main(*sys.argv[1:])
