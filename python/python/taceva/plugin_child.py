"""The process of a plugin: the host starts it, and nobody else.

The interpreter comes here before it has looked at its environment (``-I -S``), so that no code of anybody ran before the process is
confined, and no thread began that would not be. What the environment has is found after that.
"""

from __future__ import annotations

import sys

_NAME = "taceva._taceva"

# Deepest recursion that a plugin may ask for: its calls fit into the stack of its threads, and their memory into its limit.
_DEEPEST = 5_000

# What numpy, which every plugin has, imports only when it is asked for: too late for compiled code.
_LATE = ["numpy.fft", "numpy.random"]


def _extension() -> object:
    """The compiled part of the package, without the package: what that imports begins threads."""
    import os
    from importlib.machinery import EXTENSION_SUFFIXES, ExtensionFileLoader
    from importlib.util import module_from_spec, spec_from_file_location

    folder = os.path.dirname(os.path.abspath(__file__))
    for suffix in EXTENSION_SUFFIXES:
        path = os.path.join(folder, "_taceva" + suffix)
        if os.path.exists(path):
            break
    else:
        raise ImportError(f"the compiled part of taceva is missing in {folder}")
    loader = ExtensionFileLoader(_NAME, path)
    spec = spec_from_file_location(_NAME, path, loader=loader)
    if spec is None:
        raise ImportError(f"{path} cannot be loaded")
    module = module_from_spec(spec)
    sys.modules[_NAME] = module
    loader.exec_module(module)
    return module


def _bound_recursion() -> None:
    """Keep endless recursion an error, whatever limit the plugin sets: it would fill the stack or the memory first."""
    given = sys.setrecursionlimit

    def bounded(limit: int) -> None:
        given(min(limit, _DEEPEST))

    vars(sys)["setrecursionlimit"] = bounded


def _say_what_is_not_there() -> None:
    """Say that no program can be run and no file written, to libraries that would only find out by failing."""
    import os
    import tempfile

    # By which `ctypes.util.find_library` looks for compilers, which then want a file.
    os.environ["PATH"] = ""
    tempfile.tempdir = "/tmp"


def _write_no_code() -> None:
    """Tell torch, where the plugin has imported it, to compute without libraries that write code, or look at the machine, while they run."""
    backends = getattr(sys.modules.get("torch"), "backends", None)
    for name in ("mkldnn", "nnpack"):
        set_flags = getattr(getattr(backends, name, None), "set_flags", None)
        if set_flags is not None:
            set_flags(False)


def _import_plugin(folder: str, name: str, preload: list[str]) -> object:
    """Import the package ``name`` that lies at ``folder``, and give its plugin."""
    import site
    from importlib import import_module

    _bound_recursion()
    site.main()
    _say_what_is_not_there()
    # Where this package lies, if that is none of the places of the environment.
    above = __file__.rsplit("/", 2)[0]
    if above not in sys.path:
        sys.path.append(above)
    for module in [*_LATE, *preload]:
        import_module(module)
    from taceva.plugin import load

    plugin = load(name, folder)
    _write_no_code()
    return plugin


def main() -> None:
    """Serve until the host is gone."""
    import os

    code = 70
    try:
        extension = _extension()
        code = extension.serve_plugin(_import_plugin)  # type: ignore[attr-defined]
    except BaseException as error:
        print(f"{type(error).__name__}: {error}", file=sys.stderr)
    # What is registered for the end of an interpreter is not run: threads of a plugin may hang.
    os._exit(code)


if __name__ == "__main__":
    main()
