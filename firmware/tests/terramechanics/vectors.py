"""Writes vectors.csv: equations 1-11 by SciPy's adaptive quadrature, straight from their definition.

Run as `python3 vectors.py > vectors.csv` (SciPy 1.10 or later). Integrals are divided at the peak stress and where the
shear displacement changes its sign, and finely towards the entry, where it vanishes.
"""
import csv
import math
import random
import sys

from scipy.integrate import quad
from scipy.optimize import brentq

COLUMNS = "n k_c k_phi c phi K c1 c2 eta radius_m width_m slip sinkage_m drawbar_pull_n load_n torque_nm".split()


def forces(n, k_c, k_phi, c, phi, K, c1, c2, eta, r, b, slip, z):
    entry, exit_ = math.acos(1 - z / r), -math.acos(1 - eta * z / r)
    peak = (c1 + c2 * slip) * entry
    ratio = 1 - slip if slip >= 0 else 1 / (1 + slip)
    stiffness = (k_c / b + k_phi) * r**n

    def shear(theta):
        return r * ((entry - theta) - ratio * (math.sin(entry) - math.sin(theta)))

    def stresses(theta):
        front = theta if theta >= peak else entry - (theta - exit_) / (peak - exit_) * (entry - peak)
        sigma = stiffness * max(math.cos(front) - math.cos(entry), 0.0) ** n
        j = shear(theta)
        tau = (c + sigma * math.tan(phi)) * math.copysign(-math.expm1(-abs(j) / K), j)
        return sigma, tau

    scan = [entry + (exit_ - entry) * (k / 2000) ** 2 for k in range(1, 2001)]
    zeros = [brentq(shear, p, q, xtol=1e-15) for p, q in zip(scan, scan[1:]) if shear(p) * shear(q) < 0]
    towards_entry = [entry - (entry - peak) * 0.2**k for k in range(1, 12)]
    divisions = sorted([exit_, peak, entry] + zeros + towards_entry)

    def integral(f, tolerance):
        pieces = [(p, q) for p, q in zip(divisions, divisions[1:]) if q > p]
        return math.fsum(quad(f, p, q, limit=400, **tolerance)[0] for p, q in pieces)

    size = integral(lambda theta: sum(map(abs, stresses(theta))), dict(epsabs=0, epsrel=1e-6))
    to_digits = dict(epsabs=1e-14 * size, epsrel=1e-13)

    def pull(theta):
        sigma, tau = stresses(theta)
        return tau * math.cos(theta) - sigma * math.sin(theta)

    def load(theta):
        sigma, tau = stresses(theta)
        return sigma * math.cos(theta) + tau * math.sin(theta)

    def torque(theta):
        return stresses(theta)[1]

    area = r * b
    return tuple(arm * integral(f, to_digits) for arm, f in ((area, pull), (area, load), (area * r, torque)))


def main():
    draw = random.Random(11)
    rows = []
    while len(rows) < 32:
        r = draw.uniform(0.05, 0.3)
        case = dict(
            n=draw.uniform(0.2, 1.7), k_c=draw.uniform(0, 5e4), k_phi=math.exp(draw.uniform(math.log(1e5), math.log(6e6))),
            c=draw.uniform(0, 5e3), phi=draw.uniform(0.1, 0.8), K=math.exp(draw.uniform(math.log(5e-4), math.log(0.04))),
            c1=draw.uniform(0.15, 0.5), c2=draw.uniform(0, 0.5), eta=draw.choice([0.0, draw.uniform(0, 0.5)]),
            r=r, b=r * draw.uniform(0.5, 1.5), slip=draw.uniform(-0.95, 0.95), z=r * draw.uniform(0.01, 0.6))
        inside = 0.02 < case["c1"] + case["c2"] * case["slip"] < 0.98
        if not inside:
            continue
        case = {key: float(f"{value:.6g}") for key, value in case.items()}
        rows.append([*case.values(), *forces(**case)])
    out = csv.writer(sys.stdout, lineterminator="\n")
    out.writerow(COLUMNS)
    out.writerows([repr(value) for value in row] for row in rows)


main()
