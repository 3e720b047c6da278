"""Pictures of light: OpenEXR files of several primaries, layers, parts and maps."""

from checks import Custom, Light, SameLight

TAKEN = (2.0, 1.0, 0.5)


def info_tells(tool):
    """`info` says of a picture what `light` says, and reads every SOURCE."""
    layers = tool.run_json("info", "blender_multilayer.exr")
    tool.assertEqual([f["code"] for f in layers["findings"]], ["exr-layers"])
    for source in ("uniform:2", "blender_multilayer.exr:ViewLayer.Combined",
                   "latlong:blender_multilayer.exr", "uniform+blender_multilayer.exr"):
        tool.assertIn("mean", str(tool.run_json("info", source)))


ROWS = {
    "08-exr-chromaticities": [
        Light("ap1.exr", (1.0, 0.2, 0.1)),
        Light("rec709.exr", (1.0, 0.2, 0.1)),
        Light("xyz.exr", (1.0, 0.2, 0.1)),
    ],
    "09-exr-layer-order": [
        Light("blender_multilayer.exr", TAKEN, finds=("exr-layers",)),
        Light("blender_multilayer.exr:ViewLayer.AO", (0.25, 0.25, 0.25)),
        Custom("info", info_tells),
    ],
    "10-exr-multipart-depth-first": [
        Light("depth_first.exr", TAKEN, finds=("exr-layers",)),
        Light("normal_first.exr", TAKEN, finds=("exr-layers",)),
    ],
    # Pixels of 5.6 degrees and a disc with an edge: OpenEXR's own functions find 4.1% in two bands.
    "23-exr-envmap-cube": [
        SameLight("cube.exr", "latlong.exr", within=0.06),
        SameLight("cube:cube.exr", "latlong:latlong.exr", within=0.06),
    ],
}
