from physics.engine.run import simulate as simulate
