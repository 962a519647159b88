"""Trains the battling drummer's model on the Groove MIDI Dataset and writes it where the station reads it.

    OMP_NUM_THREADS=1 python -m tools.train_battle_model [--data ../shared/data/gmd] [--out FILE.npz]

About a minute on one core, with numpy alone; the same seed gives the same file on the same computer. The dataset
(Gillick et al. 2019, CC BY 4.0) is at https://magenta.tensorflow.org/datasets/groove. What the model is worth on
drummers that it has not heard: `benchmarks/battle_model.py`.
"""

import argparse
import sys
from pathlib import Path

from station.practice.battle.improvising.beat_model import MODEL_FILE
from tools.battle_training.fit_model import fitted_model, write_model
from tools.battle_training.takes import groove_takes

SEED = 14


def main() -> None:
    """Train and write."""
    words = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    words.add_argument("--data", type=Path, default=Path("../shared/data/gmd"))
    words.add_argument("--out", type=Path, default=MODEL_FILE)
    asked = words.parse_args()
    if not (asked.data / "info.csv").exists():
        words.error(f"{asked.data}: no info.csv of the Groove MIDI Dataset in it")
    model = fitted_model(groove_takes(asked.data), SEED)
    write_model(model, asked.out)
    sys.stdout.write(f"{asked.out}: {model.network.weights} weights, {asked.out.stat().st_size / 1e6:.3f} MB\n")


if __name__ == "__main__":
    main()
