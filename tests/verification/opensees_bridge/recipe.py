"""Moving loads beside the axis of a two-span bridge in OpenSees; writes the figures of the test.

Made with openseespy 3.7.1.2 (OpenSees 3.7.1). It may not be redistributed commercially without a
licence, so no extra of the project has it. With openseespy and scipy installed: python recipe.py
"""

import tomllib
from pathlib import Path

import numpy as np
import openseespy.opensees as ops
from scipy import signal

HERE = Path(__file__).parent


def deflections(case: dict, element: float = 0.25) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """X of the first load (n,), and deflection and acceleration (k, n) of (X, offset, 0)."""
    E, nu, length = case["youngs_modulus"], case["poisson_ratio"], sum(case["spans"])
    Iy, Iz, m = case["second_moment"], case["lateral_second_moment"], case["mass_per_length"]
    n = round(length / element)
    ops.wipe()
    ops.model("basic", "-ndm", 3, "-ndf", 6)
    for k in range(n + 1):
        ops.node(k, k * element, 0.0, 0.0)
        share = m * element * (0.5 if k in (0, n) else 1.0)
        ops.mass(k, share, share, share, share * (Iy + Iz) / case["area"], 0.0, 0.0)
    for k, x in enumerate(np.cumsum((0.0, *case["spans"]))):
        ops.fix(round(x / element), int(k == 0), 1, 1, 1, 0, 0)
    ops.geomTransf("Linear", 1, 0.0, 0.0, 1.0)  # an element's y and z are those of the bridge
    for k in range(n):
        section = case["area"], E, E / 2 / (1 + nu), case["torsion_constant"]
        ops.element("elasticBeamColumn", k, k, k + 1, *section, Iy, Iz, 1)
    w1, w2 = (2 * np.pi * f for f in case["damping_frequencies"])
    ratio = 2 * case["damping_ratio"] / (w1 + w2)
    ops.rayleigh(ratio * w1 * w2, 0.0, ratio, 0.0)

    ops.timeSeries("Constant", 1)
    ops.constraints("Plain")
    ops.numberer("RCM")
    ops.system("BandGen")
    ops.algorithm("Linear")
    ops.integrator("Newmark", 0.5, 0.25)
    ops.analysis("Transient")
    dt, offset = case["time_step"], case["offset"]
    steps = round((case["end"] - case["start"]) / case["speed"] / dt)
    u, a = np.zeros((2, len(case["stations"]), steps + 1))
    nodes = [round(x / element) for x in case["stations"]]
    for step in range(1, steps + 1):
        if step > 1:
            ops.remove("loadPattern", 1)
        ops.pattern("Plain", 1, 1)
        for distance in case["distances"]:
            x = case["start"] + case["speed"] * step * dt - distance
            if not 0.0 < x < length:
                continue
            k = min(int(x / element), n - 1)
            s, P = x / element - k, case["load"]
            # cubic shape functions of the deflection; w' = -ry
            force = 1 - 3 * s**2 + 2 * s**3, 3 * s**2 - 2 * s**3
            slope = element * s * (1 - s) ** 2, element * s**2 * (s - 1)
            for side, share in enumerate((1 - s, s)):
                moments = -P * offset * share, P * slope[side]
                ops.load(k + side, 0.0, 0.0, -P * force[side], *moments, 0.0)
        assert ops.analyze(1, dt) == 0
        for row, node in enumerate(nodes):
            u[row, step] = ops.nodeDisp(node, 3) + offset * ops.nodeDisp(node, 4)
            a[row, step] = ops.nodeAccel(node, 3) + offset * ops.nodeAccel(node, 4)
    return case["start"] + case["speed"] * dt * np.arange(steps + 1), u, a


def main() -> None:
    """Every tenth step; accelerations below 30 Hz, as in EN 1990, A2.4.4.2.1, without a delay."""
    case = tomllib.loads((HERE / "case.toml").read_text())
    x, u, a = deflections(case)
    low = signal.butter(4, 30.0, fs=1.0 / case["time_step"], output="sos")
    table = np.vstack([x, 1e3 * u, signal.sosfiltfilt(low, a, axis=1)])[:, ::10].T
    header = "X (m),u1 (mm),u2 (mm),a1 (m/s^2),a2 (m/s^2)"
    np.savetxt(HERE / "result.csv", table, "%.6g", delimiter=",", header=header, comments="")


if __name__ == "__main__":
    main()
