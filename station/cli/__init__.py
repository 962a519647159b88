"""(guide)"""

from station.cli.command_line import main

__all__ = ["main"]
