"""The forced Duffing oscillators that all programs integrate."""

import numpy as np

DAMPING, STIFFNESS, CUBIC, FORCE = 0.0952, 679.0, -0.679, 15.0

# Oscillator 0 after 200 periods: Taylor series of 26 terms in arithmetic of 34 digits (mpmath).
PUBLISHED = (-2.056173482458339, 31.13948284909108)


def oscillators(count):
    """Speeds of the excitation and displacements at the start, at rest; the same as in the example
    `ensemble_times` of halfshaft-dynamics."""
    part = np.arange(count) / count
    speeds, starts = 24.0 + 4.0 * part, np.sin(17.0 * part)
    speeds[0], starts[0] = 26.1, 0.1
    return speeds, starts


def ends(speeds, periods):
    """Times of the ends."""
    return periods * 2.0 * np.pi / speeds
