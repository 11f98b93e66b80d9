"""Prints the environment and its plugins as TOML. `taceva` runs it with the interpreter of the environment.

No plugin is imported. A top-level package is found without running its code.
"""
import importlib.metadata
import importlib.util
import json
import os
import sys


def text(value):
    return json.dumps(value, ensure_ascii=False).encode("utf-8", "replace").decode()


def package(name):
    """Folder of a package, or the reason why there is none."""
    try:
        spec = importlib.util.find_spec(name)
    except Exception as error:
        return None, f"{type(error).__name__}: {error}"
    if spec is None:
        return None, f"there is no module {name!r} in this environment"
    if not spec.submodule_search_locations or not spec.origin:
        return None, f"{name!r} is not a package: expected a folder with an __init__.py"
    return os.path.dirname(spec.origin), None


def main():
    lines = ["# taceva environment"]
    say = lambda key, value: lines.append(f"{key} = {text(value)}")
    say("version", ".".join(map(str, sys.version_info[:3])))
    say("readable", [path for path in (sys.prefix, sys.base_prefix, *sys.path) if os.path.exists(path)])
    folder, fault = package("taceva")
    if folder is not None:
        say("package", folder)
    for point in importlib.metadata.entry_points(group="taceva.plugins"):
        lines.append("[[plugins]]")
        say("id", point.name)
        say("module", point.value)
        if not point.value.isidentifier():
            folder, fault = None, f"expected the name of a top-level package, such as {point.value.split('.')[0].split(':')[0]!r}"
        else:
            folder, fault = package(point.value)
        if folder is not None:
            say("folder", folder)
        else:
            say("fault", fault)
    sys.stdout.buffer.write("\n".join(lines).encode() + b"\n")
    sys.stdout.buffer.flush()


main()
