"""`station bench`: how fast and exact the station is on this computer."""

import argparse


def add_options(parser: argparse.ArgumentParser) -> None:
    """Add this command's words."""
    parser.add_argument("--soak", action="store_true", help="add the long ones")
    parser.add_argument("--json", action="store_true", help="print one JSON document")


def run(arguments: argparse.Namespace) -> int:
    """Measure and print."""
    from station.bench import rows
    from station.bench.harness.run import main

    return main(rows, as_json=arguments.json, soak=arguments.soak)
