"""What is to be repeated: phrases that ask more step by step.

In: an opponent, a ground, a step 0 to `MOST_STEP`, a source of chance. Out: a `Phrase` that two hands and two feet can
play, the same for the same seed. `demands` says what each step asks, `lesson_bars` and `made_bars` are where bars come
from. Read `phrase_to_repeat`, then `demands`.
"""
