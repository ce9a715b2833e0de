"""Other public cloth solvers on the square of peers.py: Newton's Style3D and VBD, and libuipc.

Each is a class with `run(step, ...)`, which gives the positions at the end and the seconds that the steps took, without
set-up, compilation and capture.  They are optional: newton, warp-lang and pyuipc of the Python package index.
"""
import functools
import json
import subprocess
import sys
import time
from dataclasses import dataclass

import numpy as np

GRAVITY = 9.81  # [m/s^2]
RADIUS = 1e-4  # of particles [m]: Newton asks for one, and uses it in contact alone, which is off


@dataclass
class Square:
    """The mesh of hysteron's run, flat in the plane z = 0, and its material."""

    positions: np.ndarray  # [m], a row for each vertex
    triangles: np.ndarray
    held: list  # vertices that stay where they are
    tension: float  # along warp and weft [N/m]
    shear: float  # [N/m]
    rigidity: float  # in bending [N m]
    density: float  # [kg/m^2]

    def edge_heights(self, edges):
        """Mean height of the two triangles of each edge over it [m]; rows of `edges` are two corners and two ends."""
        across = self.positions[edges[:, 3]] - self.positions[edges[:, 2]]
        length = np.linalg.norm(across, axis=1)
        heights = np.zeros(len(edges))
        for corner in (0, 1):
            to = self.positions[edges[:, corner]] - self.positions[edges[:, 2]]
            heights += 0.5 * np.linalg.norm(np.cross(across, to), axis=1) / length
        return heights


class _OfNewton:
    """What both solvers of Newton have in common; `self.model` and `self.solver` come from the class below."""

    def __init__(self, square, device):
        import warp as wp

        wp.config.log_level = wp.LOG_WARNING
        self.device = device
        with wp.ScopedDevice(device):
            self.make(square)
            self.try_a_step()

    @staticmethod
    def finished(builder, square):
        import newton
        import warp as wp

        model = builder.finalize()
        flags = model.particle_flags.numpy()
        flags[square.held] &= ~int(newton.ParticleFlags.ACTIVE)
        model.particle_flags = wp.array(flags, dtype=model.particle_flags.dtype)
        model.set_gravity((0.0, 0.0, -GRAVITY))
        weight = float(model.particle_mass.numpy().sum())
        area = np.ptp(square.positions[:, 0]) * np.ptp(square.positions[:, 1])
        assert abs(weight / (square.density * area) - 1) < 1e-4, "mass"
        return model

    def try_a_step(self):
        """Compiles what a graph cannot, and allocates what it needs."""
        for _ in range(2):
            self.solver.step(self.model.state(), self.model.state(), self.model.control(), None, 1e-3)

    def simulate(self, step, steps, repeats):
        """Positions after `steps`, seconds of each repeat; on a GPU two steps are one captured graph."""
        import warp as wp

        with wp.ScopedDevice(self.device):
            states, start, control = [self.model.state(), self.model.state()], self.model.state(), self.model.control()

            def advance(at):
                states[at].clear_forces()
                self.solver.step(states[at], states[1 - at], control, None, step)

            pair, last = self.steps_of(advance, (0, 1)), self.steps_of(advance, (0,) * (steps % 2))
            pair()  # a graph is uploaded when it is launched first
            seconds = []
            while repeats.more(seconds):
                for state in states:
                    state.assign(start)
                wp.synchronize()
                begin = time.perf_counter()
                for _ in range(steps // 2):
                    pair()
                last()
                wp.synchronize()
                seconds.append(time.perf_counter() - begin)
            return states[steps % 2].particle_q.numpy().astype(float), seconds

    @staticmethod
    def steps_of(advance, order):
        """Takes these steps, each from the state that it names to the other one."""
        import warp as wp

        def directly():
            for at in order:
                advance(at)

        if not order or not wp.get_device().is_cuda:
            return directly
        with wp.ScopedCapture() as capture:
            directly()
        return lambda: wp.capture_launch(capture.graph)


class Style3D(_OfNewton):
    """SolverStyle3D: backward Euler by projective dynamics, conjugate gradients with a diagonal preconditioner.

    Stretch and shear are Baraff and Witkin's, with a stiffness in N/m each.  Its velocities lose 0.2 % in every step, a
    number in its kernel `update_velocity`; with `losses = False` that kernel is replaced by one that loses nothing.
    """

    losses = True

    def make(self, square):
        import newton
        import warp as wp
        from newton.solvers import style3d

        builder = newton.ModelBuilder(up_axis=newton.Axis.Z)
        newton.solvers.SolverStyle3D.register_custom_attributes(builder)
        style3d.add_cloth_mesh(
            builder, pos=wp.vec3(0, 0, 0), rot=wp.quat_identity(), vel=wp.vec3(0, 0, 0),
            vertices=square.positions.tolist(), indices=square.triangles.ravel().tolist(), density=square.density,
            tri_aniso_ke=wp.vec3(square.tension, square.tension, square.shear), tri_ka=0.0, tri_kd=0.0,
            edge_aniso_ke=wp.vec3(square.rigidity, square.rigidity, square.rigidity), particle_radius=RADIUS)
        self.model = self.finished(builder, square)
        self.solver = newton.solvers.SolverStyle3D(
            model=self.model, config=newton.solvers.SolverStyle3D.Config(iterations=10, linear_iterations=10))
        self.solver.collision = None

    def run(self, step, steps, repeats, iterations, linear):
        from newton._src.solvers.style3d import solver_style3d as source

        self.solver.config.iterations, self.solver.config.linear_iterations = iterations, linear
        theirs = source.update_velocity
        try:
            if not self.losses:
                source.update_velocity = velocity_without_losses(self.device)
            return self.simulate(step, steps, repeats)
        finally:
            source.update_velocity = theirs


@functools.cache
def velocity_without_losses(device):
    """Newton's kernel of this name but for the factor of 0.998, compiled."""
    import warp as wp

    @wp.kernel(module="unique")
    def update_velocity(dt: float, prev_pos: wp.array(dtype=wp.vec3), pos: wp.array(dtype=wp.vec3),
                        vel: wp.array(dtype=wp.vec3)):
        particle = wp.tid()
        vel[particle] = (pos[particle] - prev_pos[particle]) / dt

    wp.load_module(update_velocity.module, device=device)
    return update_velocity


class Vbd(_OfNewton):
    """SolverVBD: backward Euler by vertex block descent.

    Its membrane is an isotropic neo-Hookean one with Lame parameters in N/m, mu = tri_ke and lambda = tri_ka: without a
    Poisson effect (lambda = 0) the tension is 2 mu and the shear mu, so that the square must have half its tension as
    shear.  Its hinges have the energy k L theta^2/2, with k = B/h that of a bent plate (h: mean height over the edge).
    """

    def make(self, square):
        import newton
        import warp as wp

        assert abs(square.shear - 0.5 * square.tension) < 1e-9 * square.tension, "VBD's membrane is isotropic"
        builder = newton.ModelBuilder(up_axis=newton.Axis.Z)
        builder.add_cloth_mesh(
            pos=wp.vec3(0, 0, 0), rot=wp.quat_identity(), scale=1.0, vel=wp.vec3(0, 0, 0),
            vertices=square.positions.tolist(), indices=square.triangles.ravel().tolist(), density=square.density,
            tri_ke=square.shear, tri_ka=0.0, tri_kd=0.0, edge_ke=1.0, edge_kd=0.0, particle_radius=RADIUS)
        edges = np.array(builder.edge_indices)
        inner = (edges[:, :2] >= 0).all(axis=1)
        stiffness = np.zeros(len(edges))
        stiffness[inner] = square.rigidity / square.edge_heights(edges[inner])
        builder.edge_bending_properties = [(float(k), 0.0) for k in stiffness]
        builder.color(include_bending=True)
        self.model = self.finished(builder, square)
        self.solver = newton.solvers.SolverVBD(model=self.model, iterations=10, particle_enable_self_contact=False)

    def run(self, step, steps, repeats, iterations):
        self.solver.iterations = iterations
        return self.simulate(step, steps, repeats)


class Libuipc:
    """libuipc: incremental potentials by Newton's method and preconditioned conjugate gradients, in double precision.

    Its Baraff-Witkin shell has the energy lambda ((|Fu| - 1)^2 + (|Fv| - 1)^2) + mu (Fu.Fv)^2 over the area, without a
    half: lambda is half the tension and mu half the shear; its strain limit is left out (strain_rate 0).  Bending is
    that of a classical shell, E h^3/12 with E h = lambda, by the thickness h that makes it the square's.  It runs in a
    process of its own, because it ends the one that it is in where it fails.
    """

    def __init__(self, square, device, work):
        if device != "cuda":
            raise RuntimeError("libuipc runs on CUDA alone")
        self.square, self.work, self.limit = square, work, 150  # [s] of its first run, which compiles

    def run(self, step, steps, repeats, integrator, tolerance, preconditioner="diag"):
        asked = {"step": step, "steps": steps, "integrator": integrator, "tolerance": tolerance,
                 "preconditioner": preconditioner, "repeats": repeats.most, "work": str(self.work / "libuipc"),
                 "tension": self.square.tension, "shear": self.square.shear, "rigidity": self.square.rigidity,
                 "density": self.square.density, "held": self.square.held}
        given, found = self.work / "libuipc-given.npz", self.work / "libuipc-found.npz"
        np.savez(given, positions=self.square.positions, triangles=self.square.triangles)
        found.unlink(missing_ok=True)
        command = [sys.executable, __file__, json.dumps(asked), str(given), str(found)]
        done = subprocess.run(command, capture_output=True, text=True, timeout=self.limit)
        if not found.exists():
            lines = [line for line in (done.stdout + done.stderr).splitlines() if "error" in line.lower()]
            raise RuntimeError((lines or [f"libuipc ended with {done.returncode}"])[-1])
        stored = np.load(found)
        return stored["positions"], list(stored["seconds"])


def libuipc_scene(asked, positions, triangles):
    from uipc import builtin, view
    from uipc.constitution import DiscreteShellBending, ElasticModuli2D, StrainLimitingBaraffWitkinShell
    from uipc.core import Scene
    from uipc.geometry import label_surface, trimesh

    config = Scene.default_config()
    config["dt"] = asked["step"]
    config["gravity"] = [[0.0], [0.0], [-GRAVITY]]
    config["contact"]["enable"] = 0
    config["integrator"]["type"] = asked["integrator"]
    config["newton"]["velocity_tol"] = asked["tolerance"]
    config["newton"]["semi_implicit"]["enable"] = 0
    config["linear_system"]["fem_preconditioner"] = asked["preconditioner"]
    config["sanity_check"]["enable"] = 0
    scene = Scene(config)
    cloth = trimesh(np.ascontiguousarray(positions), np.ascontiguousarray(triangles, dtype=np.int32))
    label_surface(cloth)
    stretch, shear = 0.5 * asked["tension"], 0.5 * asked["shear"]
    radius = 0.5 * (12 * asked["rigidity"] / stretch) ** 0.5  # of h = 2 r with lambda h^2/12 = B
    modulus = stretch / (2 * radius)
    StrainLimitingBaraffWitkinShell().apply_to(
        cloth, ElasticModuli2D.youngs_poisson(modulus, 0.0), ElasticModuli2D.youngs_poisson(2 * shear, 0.0),
        asked["density"] / (2 * radius), radius, 0.0)
    DiscreteShellBending().apply_to(cloth, modulus, 0.0)
    for name, expected in (("lambda", stretch), ("mu", shear)):
        assert abs(view(cloth.triangles().find(name))[0] / expected - 1) < 1e-9, f"libuipc's {name}"
    weight = view(cloth.vertices().find("volume")).sum() * asked["density"] / (2 * radius)
    assert abs(weight / (asked["density"] * np.ptp(positions[:, 0]) * np.ptp(positions[:, 1])) - 1) < 1e-4, "mass"
    view(cloth.vertices().find(builtin.is_fixed))[asked["held"]] = 1
    return scene, scene.objects().create("cloth").geometries().create(cloth)[0]


def libuipc_process(asked, given, found, backend="cuda"):
    """The process of Libuipc.run(): positions and seconds of each repeat, after two steps that compile."""
    from uipc import Logger
    from uipc.core import Engine, World

    Logger.set_level(Logger.Level.Error)
    stored, seconds = np.load(given), []
    for steps in [2] + [asked["steps"]] * asked["repeats"]:
        engine = Engine(backend, asked["work"])  # which its world does not keep alive
        world = World(engine)
        scene, slot = libuipc_scene(asked, stored["positions"], stored["triangles"])
        world.init(scene)
        begin = time.perf_counter()
        for _ in range(steps):
            world.advance()
        world.retrieve()
        seconds.append(time.perf_counter() - begin)
        if not world.is_valid():
            raise RuntimeError("libuipc error: the world is not valid")
        if sum(seconds[1:]) > 2.0:
            break
    positions = np.array(slot.geometry().positions().view(), dtype=float).reshape(-1, 3)
    np.savez(found, positions=positions, seconds=seconds[1:])


if __name__ == "__main__":
    libuipc_process(json.loads(sys.argv[1]), *sys.argv[2:])
