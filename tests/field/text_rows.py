"""OBJ, MTL and PLY as the world writes them."""

from checks import Area, Custom, Radiance, Refused, Same

RED = (0.8, 0.1, 0.1)
COUNTED_RED = (0.5029, 0.0452, 0.0452)  # sRGB 188, 60, 60
GREY = (0.8, 0.8, 0.8)


def quad_keeps_its_corners(tool):
    asset, _ = tool.baked("bom_shift.obj")
    corners = {tuple(row[:3]) for row in tool.shaded(asset, "uniform")}
    tool.assertEqual(corners, {(0, 0, 0), (1, 0, 0), (1, 0, -1), (0, 0, -1)})


def is_on_the_ground(row):
    return row[1] == 0.0


def inside(row):
    """Away from the border, where a texel of the other side is mixed in."""
    return abs(row[0]) < 0.75


ROWS = {
    "01-text-bom": [
        Radiance("bom_mtllib.obj", RED, silent=("no-material", "statements-ignored")),
        Custom("bom_shift.obj", quad_keeps_its_corners),
    ],
    "02-obj-trailing-comment": [Radiance("comment.obj", GREY)],
    "03-obj-georeferenced": [
        Same("utm.obj", "origin.obj", finds=("far-origin",)),
        Same("earth-centred.ply", "near.ply", finds=("far-origin",)),
        Same("blocks-far.ply", "blocks-near.ply", finds=("far-origin",)),
    ],
    "11-mtl-texture-options": [Radiance("scale.obj", (1, 1, 1), where=inside)],
    "12-mtl-paths": [
        Radiance("mtllib_back.obj", RED, silent=("material-file-missing",)),
        Radiance("abs_win.obj", COUNTED_RED, finds=("file-found-beside",)),
    ],
    "13-ply-face-texcoord": [Radiance("wedge.ply", COUNTED_RED)],
    "14-ply-face-colors": [Radiance("facecolor.ply", COUNTED_RED)],
    "20-ngon-over-64": [Area("comb20.obj", 120.0)],
    "26-mtl-map-d": [
        Radiance("leaf.obj", (0.5,) * 3, where=lambda row: row[1] == 0.0,
                 silent=("alpha-ignored",)),
    ],
    "27-ply-header-junk": [Radiance("junk.ply", GREY, finds=("header-lines-skipped",))],
    "29-obj-ind": [Radiance("vt_ind.obj", GREY)],
    "30-colors-0-255": [
        Radiance("c255.obj", COUNTED_RED, finds=("colors-counted",)),
        Radiance("float255.ply", COUNTED_RED, finds=("colors-counted",)),
    ],
}
