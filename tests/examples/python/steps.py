import hysteron_cloth

hand = {"low": (-1, -1, -1), "high": (0.01, 1, 1)}  # holds what lies in this box on the flat cloth
scene = hysteron_cloth.Scene(cloth_shape="strip", cloth_length=0.1, cloth_width=0.03, triangles=100,
                             fabric="wool-tropical", integrator="bdf2", step=1 / 240, pin=[hand])
sim = hysteron_cloth.Simulation(scene)
while sim.time < 0.1:
    lowest = sim.positions[:, 2].min()  # [m]; a view of the simulation's memory
    sim.drive(0, velocity=(0, 0, -0.5 * lowest))  # the pin rises as the cloth falls [m/s]
    sim.advance()

print(sim.ledger["bending_friction"], sim.hand(0), sim.state_hash)
