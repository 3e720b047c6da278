"""All rows: name of a folder → what its files must come to. Numbers are closed forms or, where it
says so, a path tracer's."""

from checks import Radiance

GREY = (0.5, 0.5, 0.5)
SPHERE = (0.8, 0.8, 0.8)


def texels(*sizes):
    return [("--texels", size) for size in sizes]


ROWS = {
    "05-texel-on-diagonal": [
        # Convex bodies, all of whose texel centres lie on edges of triangles.
        *(Radiance("grid8.glb", GREY, options=o) for o in texels("8x8", "4x4")),
        *(Radiance("uvsphere64x32.glb", SPHERE, options=o, within=0.01)
          for o in texels("64x32", "32x16", "16x8")),
        Radiance("quad.glb", GREY, options=("--texels", "1x1")),
    ],
}
