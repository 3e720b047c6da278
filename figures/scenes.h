// The scenes of the papers' figures.
#pragma once

#include "lambent/scene/scene.h"

namespace lambent::figures {

scene::Material diffuseMaterial(const Rgb& albedo);
scene::Material glossyMaterial(const Rgb& reflectance, float exponent);
scene::Material mirrorMaterial(const Rgb& reflectance);

/// The same scene with every material replaced.
scene::Scene madeOf(scene::Scene scene, const scene::Material& material);

/// A mirror ring on a ground plane (sloan2002precomputed Figure 9). Mesh 0 is the ground, with UVs.
scene::Scene ringOnGround();

/// One polygon over a ground plane (Figure 10). Mesh 0 is the ground, with UVs.
scene::Scene polygonOverGround();

/// One vertex where several have the same position, with a smooth normal: for models whose patches
/// were tessellated one by one. UVs and colours are dropped.
scene::Mesh welded(const scene::Mesh& mesh);

/// Every triangle in 4^levels, bent by its normals into a smooth surface (curved PN triangles,
/// vlachos2001curved): coarse models get round silhouettes.
scene::Mesh smoothlySubdivided(scene::Mesh mesh, int levels);

}  // namespace lambent::figures
