"""The command ``taceva`` within Python: ``python -m taceva``."""

import sys


def main() -> int:
    """Carry out the command that ``sys.argv`` says; return its exit code."""
    from taceva._taceva import command

    sys.stdout.flush()
    return command(["taceva", *sys.argv[1:]])


if __name__ == "__main__":
    sys.exit(main())
