"""The command ``taceva`` within Python: ``python -m taceva``."""

import sys


def main() -> int:
    """Run the command in ``sys.argv``; return its exit code."""
    from taceva._taceva import command

    sys.stdout.flush()
    return command(["taceva", *sys.argv[1:]])


if __name__ == "__main__":
    sys.exit(main())
