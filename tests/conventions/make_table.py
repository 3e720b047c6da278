#!/usr/bin/env python3
"""Writes table.json: the numbers that Lambent's conventions come to, which the tests of the C++
library, of its shaders and of the web package all read.

usage: make_table.py [--check] (without it: writes table.json beside this file)

Everything follows from definitions, in exact or double arithmetic, and from nothing of Lambent's:
the harmonics from the derivatives of (z² − 1)^l, integrals of polynomials over intervals by their
antiderivatives, the rotation of coefficients by a quadrature that is exact for its degree.
"""
import json
import math
import sys
from fractions import Fraction
from pathlib import Path


def polynomial_value(p, z):
    value = 0.0
    for c in reversed(p):
        value = value * z + float(c)
    return value


def derivative(p):
    return [k * c for k, c in enumerate(p)][1:] or [Fraction(0)]


def legendre(l):
    """Coefficients of P_l: the l-th derivative of (z² − 1)^l / (2^l l!) (Rodrigues)."""
    p = [Fraction(0)] * (2 * l + 1)
    for k in range(l + 1):
        p[2 * k] = Fraction(math.comb(l, k) * (-1) ** (l - k))
    for _ in range(l):
        p = derivative(p)
    return [c / (2**l * math.factorial(l)) for c in p]


def harmonics(bands, d):
    """Real, orthonormal, polar axis +z, positive signs; index l(l+1)+m."""
    x, y, z = d
    values = []
    for l in range(bands):
        for m in range(-l, l + 1):
            p = legendre(l)
            for _ in range(abs(m)):
                p = derivative(p)
            k = math.sqrt((2 * l + 1) / (4 * math.pi) *
                          math.factorial(l - abs(m)) / math.factorial(l + abs(m)))
            turned = complex(x, y) ** abs(m)  # sin^m θ (cos mφ + i sin mφ)
            azimuth = 1.0 if m == 0 else math.sqrt(2) * (turned.real if m > 0 else turned.imag)
            values.append(k * polynomial_value(p, z) * azimuth)
    return values


def unit(x, y, z):
    n = math.sqrt(x * x + y * y + z * z)
    return [x / n, y / n, z / n]


def gauss_legendre(n):
    nodes = []
    p = legendre(n)
    dp = derivative(p)
    for i in range(n):
        z = math.cos(math.pi * (i + 0.75) / (n + 0.5))
        for _ in range(100):
            z -= polynomial_value(p, z) / polynomial_value(dp, z)
        nodes.append((z, 2 / ((1 - z * z) * polynomial_value(dp, z) ** 2)))
    return nodes


def rotation(axis, degrees):
    x, y, z = unit(*axis)
    c, s = math.cos(math.radians(degrees)), math.sin(math.radians(degrees))
    t = 1 - c
    return [[t * x * x + c, t * x * y - s * z, t * x * z + s * y],
            [t * x * y + s * z, t * y * y + c, t * y * z - s * x],
            [t * x * z - s * y, t * y * z + s * x, t * z * z + c]]


def rotated(bands, matrix, coefficients):
    """g(Q s) = f(s): the integral of f(Qᵀ s) y_i(s), by a product rule exact to degree 2·bands."""
    out = [0.0] * (bands * bands)
    steps = 2 * bands + 1
    for z, weight in gauss_legendre(bands + 1):
        r = math.sqrt(1 - z * z)
        for k in range(steps):
            phi = 2 * math.pi * (k + 0.5) / steps
            s = [r * math.cos(phi), r * math.sin(phi), z]
            back = [sum(matrix[j][i] * s[j] for j in range(3)) for i in range(3)]
            f = sum(c * y for c, y in zip(coefficients, harmonics(bands, back)))
            for i, y in enumerate(harmonics(bands, s)):
                out[i] += f * y * weight * 2 * math.pi / steps
    return out


def integral(p, a, b):
    total = Fraction(0)
    for k, c in enumerate(p):
        total += c / (k + 1) * (Fraction(b) ** (k + 1) - Fraction(a) ** (k + 1))
    return float(total)


def cosine_factors(bands):
    """Â_l = 2π ∫₀¹ z P_l(z) dz."""
    return [2 * math.pi * integral([Fraction(0)] + legendre(l), 0, 1) for l in range(bands)]


def lobe_moments(bands, exponent):
    """g_l = (r+1) ∫₀¹ z^r P_l(z) dz for a whole exponent r."""
    return [(exponent + 1) * integral([Fraction(0)] * exponent + legendre(l), 0, 1)
            for l in range(bands)]


def disc_zonal(bands, diameter):
    """∫ y_l0 over a cap about +z of that angular diameter (degrees)."""
    c = Fraction(math.cos(math.radians(diameter / 2)))
    return [math.sqrt((2 * l + 1) / (4 * math.pi)) * 2 * math.pi * integral(legendre(l), c, 1)
            for l in range(bands)]


def times(p, q):
    product = [0.0] * (len(p) + len(q) - 1)
    for i, a in enumerate(p):
        for j, b in enumerate(q):
            product[i + j] += float(a) * float(b)
    return product


def without_root(p, x):
    """p / (t − x), whose remainder is dropped."""
    quotient = [0.0] * (len(p) - 1)
    carry = 0.0
    for k in range(len(p) - 1, 0, -1):
        carry = float(p[k]) + carry * x
        quotient[k - 1] = carry
    return quotient


def sharpest_non_negative(bands):
    """Moments of the non-negative function of so many bands with the largest first one."""
    m = (bands - 1) // 2
    p = legendre(m + 1)
    if bands % 2 == 0:
        p = without_root([a + b for a, b in zip(p + [Fraction(0)], legendre(m + 2))], -1)
    low, high = 1 - 1 / (4 * bands), 1.0
    while polynomial_value(p, low) > 0:
        low -= 1 / (4 * bands * bands)
    for _ in range(100):
        middle = (low + high) / 2
        low, high = (low, middle) if polynomial_value(p, middle) > 0 else (middle, high)
    root = without_root(p, low)
    h = times(root, root)
    if bands % 2 == 0:
        h = times(h, [1, 1])
    moments = []
    for l in range(bands):
        integrand = times(h, legendre(l))
        moments.append(sum(2 * c / (k + 1) for k, c in enumerate(integrand) if k % 2 == 0))
    return [each / moments[0] for each in moments]


def soft_lobe(bands, exponent):
    """What a lobe's moments are multiplied with so that it is not negative, as far as one looks."""
    soft, lobe = sharpest_non_negative(bands), lobe_moments(bands, exponent)
    share = 0.0
    for i in range(100 * bands + 1):
        t = math.cos(math.pi * i / (100 * bands))
        parts = [(2 * l + 1) * lobe[l] * polynomial_value(legendre(l), t) for l in range(bands)]
        plain, softened = sum(parts), sum(a * b for a, b in zip(soft, parts))
        if plain < 0:
            share = max(share, plain / (plain - softened))
    return [1 - share + share * each for each in soft]


def share_above_horizon(exponent, cosine, steps=20_000):
    """Of (r+1)/2pi max(0, cos)^r about an axis: what lies above a horizon to whose pole it has `cosine`.
    Circles about the axis, as many of them as the lobe gives them weight."""
    total = 0.0
    for i in range(steps):
        z = ((i + 0.5) / steps) ** (1 / (exponent + 1))
        across = math.sqrt((1 - z * z) * (1 - cosine * cosine))
        total += math.acos(max(-1, min(1, -z * cosine / across))) / math.pi if across > 0 else 1
    return total / steps


def soft_gain(bands, exponent):
    """[mu, 1 + sum c_k mu^(k+1)]: what makes up for what a softened lobe has below the horizon."""
    window, lobe = soft_lobe(bands, exponent), lobe_moments(bands, exponent)
    if window[-1] == 1:
        return [[mu, 1.0] for mu in (0.0, 1.0)]
    nodes = [0.5 + 0.5 * math.cos(2 * math.pi * i / 7) for i in range(4)]
    result = [0.0] * 4
    for i, mu in enumerate(nodes):
        above = 0.0
        for l in range(bands):
            polynomial = legendre(l)
            horizon = 2 * math.pi * sum(c / (k + 1) for k, c in enumerate(polynomial))
            above += ((2 * l + 1) / (4 * math.pi) * window[l] * lobe[l] * horizon *
                      polynomial_value(polynomial, mu))
        value = (share_above_horizon(min(exponent, 3 * bands), mu) / above - 1) / mu
        lagrange = [value]
        for j, other in enumerate(nodes):
            if j != i:
                lagrange = times(lagrange, [-other / (mu - other), 1 / (mu - other)])
        result = [a + b for a, b in zip(result, lagrange)]
    return [[mu, polynomial_value([1, *result], mu)] for mu in (0.0, 0.1, 0.3, 0.6, 0.9, 1.0)]


def lat_long(d):
    x, y, z = d
    return [math.atan2(z, x) / (2 * math.pi) + 0.5, 0.5 - math.asin(max(-1, min(1, y))) / math.pi]


def filmic(x):
    x = min(max(x, 0.0), 65504.0)
    return x * (1 + 2 * x) / (1 + 2 * x * (1 + x))


def srgb_encode(x):
    return 12.92 * x if x <= 0.0031308 else 1.055 * x ** (1 / 2.4) - 0.055


def hemisphere_from_square(u, v):
    a, b = 2 * u - 1, 2 * v - 1
    if a == 0 and b == 0:
        return [0.0, 0.0, 1.0]
    if abs(a) > abs(b):
        r, phi = a, math.pi / 4 * b / a
    else:
        r, phi = b, math.pi / 2 - math.pi / 4 * a / b
    across = r * math.sqrt(2 - r * r)
    return [across * math.cos(phi), across * math.sin(phi), 1 - r * r]


def table():
    directions = [[1, 0, 0], [0, 1, 0], [0, 0, 1], [-1, 0, 0], [0, -1, 0], [0, 0, -1]]
    directions += [unit(*d) for d in ([1, 1, 1], [-1, 1, 1], [1, -1, 1], [1, 1, -1], [1, 2, 3],
                                      [-3, 1, 2], [2, -3, -1], [-1, -2, 2], [5, 1, 0], [0, 5, -1],
                                      [1, 0, 5], [-2, -2, -1], [3, -1, 7], [-1, 6, -2])]
    matrix = rotation([1, 2, -2], 50)
    before = [round(math.sin(1.0 + 2.3 * i), 6) for i in range(25)]
    squares = [[0.5, 0.5], [0.0625, 0.0625], [0.9375, 0.3125], [0.25, 0.75], [0.75, 0.25],
               [0.5, 0.9], [0.1, 0.5], [0.8, 0.8], [0.35, 0.05]]
    return {
        "about": "Lambent's conventions as numbers; written by make_table.py from definitions",
        "harmonics": [{"direction": d, "bands": 10 if k in (10, 13) else 5,
                       "values": harmonics(10 if k in (10, 13) else 5, d)}
                      for k, d in enumerate(directions)],
        "rotation": {"bands": 5, "dstFromSrc": matrix, "before": before,
                     "after": rotated(5, matrix, before)},
        "latLong": [{"direction": d, "uv": lat_long(d)} for d in directions
                    if abs(d[1]) < 1 and not (d[2] == 0 and d[0] < 0)],
        "cosineFactors": cosine_factors(10),
        "lobeMoments": [{"exponent": r, "values": lobe_moments(10, r)} for r in (1, 4, 16, 50)],
        "softLobes": [{"bands": n, "exponent": r, "window": soft_lobe(n, r), "gain": soft_gain(n, r)}
                      for n, r in ((1, 4), (2, 50), (4, 16), (5, 2), (5, 80), (10, 50), (10, 400))],
        "disc": [{"diameter": d, "zonal": disc_zonal(10, d)} for d in (5, 60, 180)],
        "filmic": [[x, filmic(x)] for x in (-1, 0, 0.01, 0.18, 0.5, 1, 4, 16, 1000)],
        "srgb": [[x, srgb_encode(x)] for x in (0, 0.001, 0.0031308, 0.0040, 0.18, 0.5, 0.9, 1)],
        "viewSquare": [{"square": s, "direction": hemisphere_from_square(*s)} for s in squares],
    }


def main():
    path = Path(__file__).with_name("table.json")
    text = json.dumps(table(), indent=1, ensure_ascii=False) + "\n"
    if "--check" not in sys.argv[1:]:
        path.write_text(text, encoding="utf-8")
        return 0
    # Not text against text: the last digits of a sine are the machine's own.
    def differ(a, b):
        if isinstance(a, dict):
            return not isinstance(b, dict) or a.keys() != b.keys() or \
                any(differ(a[k], b[k]) for k in a)
        if isinstance(a, list):
            return not isinstance(b, list) or len(a) != len(b) or \
                any(differ(x, y) for x, y in zip(a, b))
        if isinstance(a, (int, float)) and not isinstance(a, bool):
            return not isinstance(b, (int, float)) or abs(a - b) > 1e-12 * max(1, abs(a))
        return a != b
    if differ(json.loads(text), json.loads(path.read_text(encoding="utf-8"))):
        print("table.json is not what make_table.py writes", file=sys.stderr)
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main())
