// The normal that a surface is shaded with, and the view mirrored about it.

// As scene::surfaceAt: what is interpolated, made unit, on the side of the triangle that is seen.
// `front`: the triangle's own normal, unit.
vec3 shadingNormal(vec3 interpolated, vec3 front) {
  vec3 normal = dot(interpolated, interpolated) > 1e-30 ? normalize(interpolated) : front;
  float side = dot(normal, front);
  return side < 0.0 ? normalize(normal - 2.0 * side * front) : normal;
}

// math::reflectAbout: both unit, both pointing away from the surface, and so is what comes of them.
vec3 reflectAbout(vec3 outgoing, vec3 normal) {
  return 2.0 * dot(normal, outgoing) * normal - outgoing;
}
