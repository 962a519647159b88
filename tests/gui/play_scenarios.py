"""Plays scenarios in a process of its own (`scenarios.main`): `play_scenarios.py NAME[+NAME…] SESSIONS OUT [PNG]`.

The workers that a window starts read this file again: it brings them no scenario and no window.
"""

import sys

if __name__ == "__main__":
    from tests.gui.scenarios import main

    main(*sys.argv[1:])
