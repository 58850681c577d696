"""Tables of a head against a reference, made here from what is put into them; nothing of the analysis is used."""

import numpy as np

from tumble.calibrations.methods.dividing_head.observations import Observations


def rests(error_deg, *, step_deg=5.0, turns=1.0, noise_deg=1e-3, seed=1, wrap=False, **columns):
    """Rests there and back; `error_deg(angle, direction, time)` is reference minus head."""
    up = np.arange(0.0, 360.0 * turns + 1e-9, step_deg)
    angle_deg = np.concatenate([up, up[-2::-1]])
    direction = np.concatenate([np.ones(len(up)), -np.ones(len(up) - 1)]).astype(int)
    time_s = 3.0 * np.arange(len(angle_deg))
    noise = noise_deg * np.random.default_rng(seed).standard_normal(len(angle_deg))
    reference_deg = angle_deg + error_deg(angle_deg, direction, time_s) + noise
    return Observations(
        row=np.arange(1, len(angle_deg) + 1),
        angle_deg=angle_deg,
        reference_deg=reference_deg % 360.0 if wrap else reference_deg,
        time_s=time_s,
        direction=direction,
        **columns,
    )


def stream(error_deg, *, speed_deg_s=30.0, late_s=0.0, rest_s=3.0, noise_deg=2e-3, seed=1):
    """Samples every 10 ms: rest, one turn forward, rest, back, rest; what the reference says is `late_s` old."""
    time_s = np.arange(0.0, 3 * rest_s + 720.0 / speed_deg_s, 0.01)
    turn_s = 360.0 / speed_deg_s
    knots_s = np.cumsum([0.0, rest_s, turn_s, rest_s, turn_s, rest_s])
    knots_deg = [0.0, 0.0, 360.0, 360.0, 0.0, 0.0]

    def head_deg(at_s):
        return np.interp(at_s, knots_s, knots_deg)

    angle_deg = head_deg(time_s)
    seen_deg = head_deg(time_s - late_s)
    velocity = np.gradient(angle_deg, time_s)
    back = np.where(time_s > knots_s[3], -1, 1)
    noise = noise_deg * np.random.default_rng(seed).standard_normal(len(time_s))
    return Observations(
        row=np.arange(1, len(time_s) + 1),
        angle_deg=angle_deg,
        reference_deg=(seen_deg + error_deg(seen_deg, back, time_s) + noise + 180.0) % 360.0 - 180.0,
        time_s=time_s,
        velocity_deg_s=velocity,
    )
