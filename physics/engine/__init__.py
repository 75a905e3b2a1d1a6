"""The engine: `simulate` a scene, many of them, or step by step with a `Simulation`."""

from physics.engine.many import simulate as simulate
from physics.engine.many import simulate_many as simulate_many
from physics.engine.simulation import Simulation as Simulation
