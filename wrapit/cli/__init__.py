"""The command line: arguments in, exit code out. Everything heavy is imported inside the commands."""

from wrapit.cli.main import main

__all__ = ["main"]
