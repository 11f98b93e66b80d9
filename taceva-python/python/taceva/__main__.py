"""The command ``taceva`` within Python: ``python -m taceva``."""

import os
import sys
from pathlib import Path


def main() -> int:
    """Carry out the command that ``sys.argv`` says; return its exit code."""
    from taceva._taceva import command

    sys.stdout.flush()
    # Plugins in libraries run in a process of their own, which an interpreter cannot be: the wheel brings a program for it.
    child = Path(__file__).with_name("bin") / "taceva-host-child"
    return command(["taceva", *sys.argv[1:]], os.fspath(child) if os.access(child, os.X_OK) else None)


if __name__ == "__main__":
    sys.exit(main())
