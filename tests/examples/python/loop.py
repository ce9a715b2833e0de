import numpy as np

import hysteron_cloth

fabric = hysteron_cloth.Fabric("cotton-broad", k0=60)
law = hysteron_cloth.Law("prandtl", fabric, stops=16)

curvature = np.concatenate([np.linspace(0, 150, 60), np.linspace(150, -150, 120)])  # [1/m]
state = law.rest(1000)  # a thousand elements, flat and without history
for k in curvature:
    moment = law.step(state, np.full(1000, k))  # [N], shape (1000,)

print(law.residual(state)[0], law.dissipated(state)[0])  # [1/m], [J/m^2]
