// The patch's axes, as shade::worldFromPatch: the tangent made orthonormal to a unit normal, their
// cross product, the normal.

mat3 worldFromPatch(vec3 normal, vec3 tangent) {
  vec3 along = tangent - dot(normal, tangent) * normal;
  float across = length(along);
  if (across > 1e-6) {
    along /= across;
  } else {
    float sign = normal.z < 0.0 ? -1.0 : 1.0;
    float a = -1.0 / (sign + normal.z);
    along = vec3(1.0 + sign * normal.x * normal.x * a, sign * normal.x * normal.y * a,
                 -sign * normal.x);
  }
  return mat3(along, cross(normal, along), normal);
}
