"""The online identifier against its formulas."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

import lacuna

POLE, GAIN, H = 8.0, 500.0, 1e-3


def sine(n: int = 400, units: int = 6) -> tuple[np.ndarray, np.ndarray]:
    t = np.arange(n + 1) * H
    x = np.sin(7.0 * t)
    layer = lacuna.SigmoidLayer(np.linspace(-1, 1, units), np.linspace(-2, 2, units)[:, None], [1.0])
    return x, layer.regressor(x[:-1, None])


def by_hand(scheme: str, x: np.ndarray, phi: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Estimates and weights by the formulas of the schemes."""
    estimate, weight = 0.0, np.zeros(phi.shape[1])
    estimates, weights = [], []
    for k, p in enumerate(phi):
        if scheme == "midpoint":
            middle, q = 0.5 * (x[k] + x[k + 1]), 0.25 * H * H * GAIN * (p @ p)
            error = ((1 + 0.5 * POLE * H) * middle - estimate - 0.5 * H * (weight @ p)) / (1 + 0.5 * POLE * H + q)
            estimate, weight = 2 * (middle - error) - estimate, weight + H * GAIN * error * p
        elif scheme == "exponential":
            rho = np.exp(-POLE * H)
            b = (1 - rho) / POLE
            error = (x[k + 1] - rho * estimate - b * (weight @ p)) / (1 + GAIN * b * b * (p @ p))
            estimate, weight = x[k + 1] - error, weight + GAIN * b * error * p
        else:
            error = x[k] - estimate
            estimate, weight = estimate + H * (-POLE * estimate + weight @ p), weight + H * GAIN * error * p
        estimates.append(estimate)
        weights.append(weight)
    return np.array(estimates), np.array(weights)


@pytest.mark.parametrize("scheme", ["midpoint", "exponential", "euler"])
def test_the_schemes_are_their_formulas(scheme: Any) -> None:
    x, phi = sine()
    followed = lacuna.Identifier(6, scheme=scheme).follow(x, phi, H)
    estimates, weights = by_hand(scheme, x, phi)
    assert np.allclose(followed.estimates, estimates, rtol=0, atol=1e-10)
    assert np.allclose(followed.weights, weights, rtol=0, atol=1e-8)
    assert np.allclose(followed.errors, x[1:] - followed.estimates, rtol=0, atol=1e-15)
    assert np.std(followed.errors[100:]) < 0.35 * np.std(x)


def test_following_at_once_and_step_by_step_have_the_same_bits() -> None:
    x, phi = sine()
    at_once, stepped = lacuna.Identifier(6), lacuna.Identifier(6)
    followed = at_once.follow(x, phi, np.full(len(phi), H))
    for k, regressor in enumerate(phi):
        assert stepped.step(x[k], x[k + 1], regressor, H) == followed.errors[k]
    assert np.array_equal(stepped.weights, followed.weights[-1]) and stepped.estimate == at_once.estimate
    # Going on is going on.
    halves = lacuna.Identifier(6)
    first, second = halves.follow(x[:201], phi[:200], H), halves.follow(x[200:], phi[200:], H)
    assert np.array_equal(np.concatenate([first.errors, second.errors]), followed.errors)


@pytest.mark.parametrize("units", [7, 8, 9, 20, 32])
def test_units_that_say_nothing_change_no_bit(units: int) -> None:
    x, phi = sine()
    wide = np.zeros((len(phi), units))
    wide[:, :6] = phi
    one, other = lacuna.Identifier(6).follow(x, phi, H), lacuna.Identifier(units).follow(x, wide, H)
    assert np.array_equal(one.errors, other.errors) and np.array_equal(one.weights, other.weights[:, :6])
    assert not other.weights[:, 6:].any()


def test_the_bound_holds_for_any_comparison() -> None:
    x, phi = sine()
    for comparison in (np.zeros(6), np.linspace(-3, 3, 6)):
        certificate = lacuna.Identifier(6).follow(x, phi, H, comparison=comparison).certificate
        assert certificate is not None and certificate["holds"] is True
        assert 0 < certificate["error_energy"] <= certificate["bound"] and certificate["worst_residual"] < 1e-9
    assert lacuna.Identifier(6).follow(x, phi, H).certificate is None


def test_a_dead_zone_lets_small_errors_be() -> None:
    x, phi = sine()
    resting = lacuna.Identifier(6, scheme="exponential", dead_zone=100.0).follow(x, phi, H)
    assert not resting.weights.any()


def test_arrays_of_any_layout_are_read_and_none_is_written() -> None:
    x, phi = sine()
    usual = lacuna.Identifier(6).follow(x, phi, H)
    kept = phi.copy()
    unaligned = np.frombuffer(b"x" + phi.tobytes(), dtype=np.float64, offset=1).reshape(phi.shape)
    assert not unaligned.flags.aligned
    for same in (np.asfortranarray(phi), phi[::-1][::-1], phi.tolist(), phi.astype(">f8"), unaligned):
        assert np.array_equal(lacuna.Identifier(6).follow(x, same, H).weights, usual.weights)
    phi.flags.writeable = False
    assert np.array_equal(lacuna.Identifier(6).follow(x, phi, H).weights, usual.weights)
    assert np.array_equal(phi, kept)


def test_the_layer_is_its_formula() -> None:
    random = np.random.default_rng(3)
    threshold, weight = random.normal(size=40), random.normal(size=(40, 3))
    scale, inputs = np.array([2.0, 0.5, 7.0]), random.normal(size=(50, 3))
    z = threshold + (inputs / scale) @ weight.T
    logistic = lacuna.SigmoidLayer(threshold, weight, scale)
    assert np.allclose(logistic.regressor(inputs), 1 / (1 + np.exp(-z)), atol=1e-14)
    assert np.allclose(lacuna.SigmoidLayer(threshold, weight, scale, "tanh").regressor(inputs), np.tanh(z), atol=1e-14)
    one = logistic.regressor(inputs[4])
    assert one.shape == (40,) and np.array_equal(one, logistic.regressor(inputs)[4])
    assert (logistic.units, logistic.inputs) == (40, 3) and logistic.regressor(np.zeros((0, 3))).shape == (0, 40)


def test_what_cannot_be_built_or_followed_is_said() -> None:
    x, phi = sine(10)
    build, layer = lacuna.Identifier, lacuna.SigmoidLayer
    bad: list[tuple[Any, str]] = [
        (lambda: build(0), "1 to 32"),
        (lambda: build(33), "1 to 32"),
        (lambda: build(6, pole=-1.0), "pole"),
        (lambda: build(6, gain=float("nan")), "gain"),
        (lambda: build(6, start=float("inf")), "start value"),
        (lambda: build(6, scheme="rk4"), "'midpoint'"),  # type: ignore[arg-type]
        (lambda: build(6, dead_zone=1.0), "no dead zone"),
        (lambda: build(6, scheme="exponential", dead_zone=-1.0), "must not be negative"),
        (lambda: build(6).follow(x, phi[:, :5], H), "5 columns; give 6"),
        (lambda: build(6).follow(x[:-1], phi, H), "10 numbers; give 11"),
        (lambda: build(6).follow(x, phi[0], H), "shape"),
        (lambda: build(6).follow(x, phi, [H]), "1 numbers; give 10"),
        (lambda: build(6).follow(x, phi, H, comparison=[1.0]), "1 numbers; give 6"),
        (lambda: build(6).step(0.0, 1.0, [1.0], H), "1 numbers; give 6"),
        (lambda: layer([0.0, float("nan")], [[1.0], [1.0]], [1.0]), "unit 1"),
        (lambda: layer([0.0, 0.0], [[1.0], [float("inf")]], [1.0]), "unit 1, input 0"),
        (lambda: layer([0.0], [[1.0]], [0.0]), "scale of input 0"),
        (lambda: layer([0.0], [[1.0]], [1.0], "relu"), "'tanh'"),  # type: ignore[arg-type]
        (lambda: layer([0.0], [1.0], [1.0]), "shape"),
        (lambda: layer([0.0], np.zeros((1, 33)), np.ones(33)), "1 to 32 inputs"),
        (lambda: layer([0.0], [[1.0]], [1.0]).regressor([[1.0, 2.0]]), "shape"),
    ]
    for make, message in bad:
        with pytest.raises(lacuna.LacunaError, match=message):
            make()
