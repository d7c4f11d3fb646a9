"""`python -m workbench`, and the command `workbench`."""

import sys

INTERRUPTED = 130  # as of the verbs themselves


def command() -> None:
    """Run the command line; Ctrl-C while it is still being imported ends it quietly, too: nothing has begun."""
    try:
        from workbench.cli.app import main  # noqa: PLC0415 - may be interrupted

        main()
    except KeyboardInterrupt:
        sys.exit(INTERRUPTED)


if __name__ == "__main__":
    command()
