# Equations 1-11 by scipy.integrate.quad with its default tolerances, divided at the peak stress.
# Prints the seconds for one evaluation (fastest of five), then drawbar pull, load and torque of each slip.
import math
import sys
import time

from scipy.integrate import quad

r, b, z, n, stiffness, c, phi, K, c1, c2, eta, *slips = map(float, sys.argv[1:])


def forces(slip):
    entry, exit_ = math.acos(1 - z / r), -math.acos(1 - eta * z / r)
    peak = (c1 + c2 * slip) * entry
    k = stiffness * r**n
    cos_entry, sin_entry, tan_phi = math.cos(entry), math.sin(entry), math.tan(phi)

    def stresses(theta):
        front = theta if theta >= peak else entry - (theta - exit_) / (peak - exit_) * (entry - peak)
        sigma = k * max(math.cos(front) - cos_entry, 0.0) ** n
        j = r * ((entry - theta) - (1 - slip) * (sin_entry - math.sin(theta)))
        return sigma, (c + sigma * tan_phi) * (1 - math.exp(-j / K))

    def pull(theta):
        sigma, tau = stresses(theta)
        return tau * math.cos(theta) - sigma * math.sin(theta)

    def load(theta):
        sigma, tau = stresses(theta)
        return sigma * math.cos(theta) + tau * math.sin(theta)

    def torque(theta):
        return stresses(theta)[1]

    def integral(f):
        return quad(f, exit_, peak)[0] + quad(f, peak, entry)[0]

    return r * b * integral(pull), r * b * integral(load), r * r * b * integral(torque)


def repeat():
    start = time.perf_counter()
    for _ in range(50):
        for slip in slips:
            forces(slip)
    return (time.perf_counter() - start) / (50 * len(slips))


print(min(repeat() for _ in range(5)))
for slip in slips:
    print(*forces(slip))
