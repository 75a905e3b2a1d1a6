"""What the engine has promised (issue 3), and whether it keeps it."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class Targets:
    """position, displacement: m at the end; energy: shares of what swings; tension: share; jitter: m/s, rad/s;
    cpu: inklined's CPU time as a share of the peer's, at the peer's accuracy or better."""

    position: float = 1e-6
    energy: float = 1e-8
    chain_energy: float = 1e-3
    tension: float = 1e-7
    displacement: float = 1e-3
    jitter: float = 1e-12
    cpu: float = 1.0


TARGETS = Targets()


def verdict(value: float, target: float) -> str:
    """ "met" or "missed", with the target."""
    return f"<= {target:.0e} {'met' if value <= target else 'MISSED'}"
