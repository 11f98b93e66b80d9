"""``python -m taceva.plugin``: commands for authors of plugins."""

from __future__ import annotations

import argparse
import os
import sys


def main(arguments: list[str] | None = None) -> int:
    """Run the command in ``arguments``; return the exit code."""
    parser = argparse.ArgumentParser(prog="python -m taceva.plugin", description="For authors of plugins in Python.")
    commands = parser.add_subparsers(dest="command", required=True)
    manifest = commands.add_parser(
        "manifest", help="print the plugin.toml of the module; the exit code is 1 if the file differs"
    )
    manifest.add_argument("module", help="the package, by its import name")
    manifest.add_argument("--write", action="store_true", help="write plugin.toml into the package instead of printing it")
    manifest.add_argument("--license", help="the licence of a new manifest, such as MIT")
    given = parser.parse_args(arguments)
    try:
        return _manifest(given.module, given.license, given.write)
    except Exception as error:
        print(f"{given.module}: {type(error).__name__}: {error}", file=sys.stderr)
        return 1


def _manifest(name: str, license: str | None, write: bool) -> int:
    from taceva._taceva import plugin_manifest
    from taceva.plugin import load

    sys.path.insert(0, os.getcwd())
    plugin = load(name)
    origin = sys.modules[name].__file__
    if origin is None or os.path.basename(origin) != "__init__.py":
        raise TypeError(f"{name} is not a package, expected a folder with an __init__.py")
    path = os.path.join(os.path.dirname(os.path.abspath(origin)), "plugin.toml")
    text = ""
    if os.path.exists(path):
        with open(path, encoding="utf-8") as file:
            text = file.read()
    written = plugin_manifest(plugin, name, text, license)
    if not write:
        sys.stdout.write(written)
        return 0 if written == text else 1
    if written != text:
        beside = f"{path}.{os.getpid()}.partial"
        with open(beside, "w", encoding="utf-8") as file:
            file.write(written)
        os.replace(beside, path)
    print(f"{path}: {'written' if not text else 'agrees with the module' if written == text else 'updated from the module'}")
    return 0
