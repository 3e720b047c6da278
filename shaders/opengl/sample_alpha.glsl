// What the alpha of one sub-sample's picture says: 0 where nothing is, 1 where something is, and where
// that is seen through the air (accumulate.comp.glsl) minus how far away it is.

// `eye`: position, 1; or the unit direction to an orthographic viewer, 0, before whom there is no air.
float coveredAt(vec3 position, vec4 eye) {
  return eye.w > 0.0 ? -max(length(position - eye.xyz), 1e-30) : 1.0;
}
