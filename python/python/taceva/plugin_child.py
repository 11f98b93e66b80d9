"""Process of a plugin; only the host starts it.

The interpreter starts this file before it reads its environment (``-I -S``). No foreign code runs, and no thread starts, before the process
is confined. The packages of the environment are found afterwards.
"""

from __future__ import annotations

import sys

_NAME = "taceva._taceva"

# Greatest recursion limit that a plugin may set; its calls fit into the stack of its threads, and their memory into its limit.
_DEEPEST = 5_000

# Modules that numpy imports only on first use, which would be too late for compiled code.
_LATE = ["numpy.fft", "numpy.random"]


def _extension() -> object:
    """Return the compiled part of the package without importing the package, whose imports start threads."""
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
    """Bound the limit that ``sys.setrecursionlimit`` sets, so that endless recursion raises an error before it fills the stack or the memory."""
    given = sys.setrecursionlimit

    def bounded(limit: int) -> None:
        given(min(limit, _DEEPEST))

    vars(sys)["setrecursionlimit"] = bounded


def _say_what_is_not_there() -> None:
    """Empty ``PATH`` and fix the temporary folder, for libraries that would otherwise search for programs or write files."""
    import os
    import tempfile

    # Otherwise `ctypes.util.find_library` would search for compilers, which need a file.
    os.environ["PATH"] = ""
    tempfile.tempdir = "/tmp"


def _write_no_code() -> None:
    """Make torch, if imported, compute without libraries that generate code or inspect the machine at run time."""
    backends = getattr(sys.modules.get("torch"), "backends", None)
    for name in ("mkldnn", "nnpack"):
        set_flags = getattr(getattr(backends, name, None), "set_flags", None)
        if set_flags is not None:
            set_flags(False)


def _import_plugin(folder: str, name: str, preload: list[str]) -> object:
    """Import the package ``name`` from ``folder``, and return its plugin."""
    import site
    from importlib import import_module

    _bound_recursion()
    site.main()
    _say_what_is_not_there()
    # Folder of this package, if it is not in the environment.
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
    """Serve until the host ends."""
    import os

    code = 70
    try:
        extension = _extension()
        code = extension.serve_plugin(_import_plugin)  # type: ignore[attr-defined]
    except BaseException as error:
        print(f"{type(error).__name__}: {error}", file=sys.stderr)
    # Skips exit handlers of the interpreter, because threads of a plugin may hang.
    os._exit(code)


if __name__ == "__main__":
    main()
