"""The stick as a body, against closed forms for uniform rods and beams."""

import math

import numpy as np
import pytest

from station.simulation.sticks import swing_body
from station.simulation.sticks.swing_body import STICK_5A, StickBody, bending_shape, fulcrum_kick_m, ringing


def test_mass_of_a_5a() -> None:
    # makers sell 5A hickory as 44–55 g a stick
    assert 0.044 < STICK_5A.mass_kg < 0.055


def test_taper_moves_the_centre_towards_the_butt() -> None:
    assert 0.45 * swing_body.LENGTH_M < STICK_5A.centre_m < 0.5 * swing_body.LENGTH_M


def test_inertia_is_a_little_less_than_a_uniform_rods() -> None:
    rod = STICK_5A.mass_kg * swing_body.LENGTH_M**2 / 12
    assert 0.85 * rod < STICK_5A.inertia_kg_m2 < rod


def test_first_bending_mode() -> None:
    # f = 22.373/(2π L²)·√(E I/ρA) by hand with √(E/ρ) = 4564 m/s, d/4 = 3.6 mm, L² = .1648 m²: 355 Hz
    assert STICK_5A.bending_hz == pytest.approx(355, abs=1)


def test_bending_shape_of_a_free_beam() -> None:
    # nodes at .2242 and .7758 of its length, ends at 2, middle at −1.2157 (Blevins 1979, table 8-1)
    length = swing_body.LENGTH_M
    assert bending_shape(0.0) == pytest.approx(2.0)
    assert bending_shape(length) == pytest.approx(2.0, abs=1e-4)
    assert bending_shape(0.2242 * length) == pytest.approx(0.0, abs=1e-3)
    assert bending_shape(0.5 * length) == pytest.approx(-1.2157, abs=1e-3)


def test_uniform_rod_held_at_a_third_throws_nothing_back_from_its_end() -> None:
    # centre of percussion of a rod about a point L/3 from one end is the other end
    length = swing_body.LENGTH_M
    rod = StickBody(0.05, length / 2, 0.05 * length**2 / 12, 355.0)
    assert fulcrum_kick_m(length, rod) == pytest.approx(0.0, abs=1e-12)
    assert fulcrum_kick_m(0.8 * length, rod) > 0


def test_kick_obeys_newton_and_euler() -> None:
    c = STICK_5A.centre_m - swing_body.FULCRUM_M
    struck = 0.33
    fulcrum = fulcrum_kick_m(struck)  # for 1 rad/s²
    reaction = -swing_body.HAND_MASS_KG * fulcrum
    force = STICK_5A.mass_kg * (fulcrum + c) - reaction
    moment = force * (struck - STICK_5A.centre_m) - reaction * c
    assert moment == pytest.approx(STICK_5A.inertia_kg_m2)


def test_a_tap_rings_at_the_bending_mode_and_dies() -> None:
    step = 1 / 8000
    force = np.zeros(1024)
    force[:4] = 20.0
    rung = ringing(force, step, swing_body.LENGTH_M, 0.0)
    loudest = np.fft.rfftfreq(1024, step)[np.abs(np.fft.rfft(rung[8:], 1024)).argmax()]
    assert loudest == pytest.approx(355, abs=16)
    assert np.abs(rung[-100:]).max() < 1e-3 * np.abs(rung[8:100]).max()


def test_a_slow_push_does_not_ring() -> None:
    step = 1 / 8000
    t = np.arange(2000) * step
    slow = 20 * np.sin(math.pi * t / 0.25) ** 2
    rung = ringing(slow, step, swing_body.LENGTH_M, 0.0)
    assert np.abs(rung).max() < 0.01 * 4 * 20 / STICK_5A.mass_kg
