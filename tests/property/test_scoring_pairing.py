"""Properties of pairing: the least cost that any one-to-one matching can have, found by trying them all.

The expected cost comes from scipy's linear sum assignment over a square matrix in which being left alone costs nothing:
another implementation of the same problem, which knows nothing of order.
"""

import numpy as np
from hypothesis import given
from hypothesis import strategies as st
from scipy.optimize import linear_sum_assignment

from station.scoring.matching.pairing import Room, least_cost, pair_nearest

REACH = 50
WIDTH = REACH + 1  # the edge itself is within reach

TIMES = st.lists(st.integers(0, 400), max_size=12)
DENSE = st.lists(st.integers(0, 120), max_size=14)


def cost_of(notes: list[int], hits: list[int], partner: list[int]) -> float:
    return sum(((hits[j] - notes[i]) / WIDTH) ** 2 - 1 for i, j in enumerate(partner) if j >= 0)


def least_cost_by_assignment(notes: list[int], hits: list[int]) -> float:
    size = len(notes) + len(hits)
    cost = np.zeros((size, size))
    for i, note in enumerate(notes):
        for j, hit in enumerate(hits):
            cost[i, j] = min(((hit - note) / WIDTH) ** 2 - 1, 0.0)
    rows, columns = linear_sum_assignment(cost)
    return float(cost[rows, columns].sum())


def check(notes: list[int], hits: list[int]) -> None:
    partner = pair_nearest(np.array(notes, np.int64), np.array(hits, np.int64), REACH).tolist()
    taken = [j for j in partner if j >= 0]
    assert len(set(taken)) == len(taken)
    assert all(abs(hits[j] - notes[i]) <= REACH for i, j in enumerate(partner) if j >= 0)
    assert abs(cost_of(notes, hits, partner) - least_cost_by_assignment(notes, hits)) < 1e-9


@given(TIMES, TIMES)
def test_no_matching_costs_less(notes: list[int], hits: list[int]) -> None:
    check(notes, hits)


@given(DENSE, DENSE)
def test_no_matching_costs_less_in_a_tangle(notes: list[int], hits: list[int]) -> None:
    check(notes, hits)


@given(DENSE, DENSE)
def test_dynamic_programme_alone_is_exact(notes: list[int], hits: list[int]) -> None:
    notes, hits = sorted(notes), sorted(hits)
    pairs = least_cost(notes, hits, [(at - REACH, at + REACH) for at in notes], REACH)
    partner = [-1] * len(notes)
    for i, j in pairs:
        partner[i] = j
    assert abs(cost_of(notes, hits, partner) - least_cost_by_assignment(notes, hits)) < 1e-9


@given(st.lists(st.integers(0, 300), max_size=10, unique=True), DENSE, st.data())
def test_no_matching_costs_less_where_rooms_differ(times: list[int], hits: list[int], data: st.DataObject) -> None:
    """Each note has its own room; rooms are made so that they begin and end in the order of the notes."""
    notes = sorted(times)
    room = st.lists(st.integers(0, REACH), min_size=len(notes), max_size=len(notes))
    first = np.maximum.accumulate(np.array(notes, np.int64) - np.array(data.draw(room), np.int64))
    last = np.minimum.accumulate((np.array(notes, np.int64) + np.array(data.draw(room), np.int64))[::-1])[::-1]
    cost = np.zeros((len(notes) + len(hits),) * 2)
    for i, note in enumerate(notes):
        for j, hit in enumerate(hits):
            if first[i] <= hit <= last[i]:
                cost[i, j] = ((hit - note) / WIDTH) ** 2 - 1
    best = float(cost[linear_sum_assignment(cost)].sum())
    at = np.array(notes, np.int64)
    partner = pair_nearest(at, np.array(hits, np.int64), REACH, Room(at - first, last - at)).tolist()
    assert all(first[i] <= hits[j] <= last[i] for i, j in enumerate(partner) if j >= 0)
    assert abs(cost_of(notes, hits, partner) - best) < 1e-9


@given(TIMES, TIMES, st.integers(-(10**15), 10**15))
def test_moving_all_changes_nothing(notes: list[int], hits: list[int], by: int) -> None:
    here = pair_nearest(np.array(notes, np.int64), np.array(hits, np.int64), REACH)
    there = pair_nearest(np.array(notes, np.int64) + by, np.array(hits, np.int64) + by, REACH)
    assert here.tolist() == there.tolist()


@given(st.lists(st.integers(0, 400), max_size=10, unique=True))
def test_order_of_input_changes_nothing(times: list[int]) -> None:
    notes = np.array(times, np.int64)
    hits = notes + 7
    order = np.random.default_rng(len(times)).permutation(len(times))
    partner = pair_nearest(notes, hits[order], REACH)
    straight = pair_nearest(notes, hits, REACH)
    assert [int(order[j]) if j >= 0 else -1 for j in partner] == straight.tolist()
