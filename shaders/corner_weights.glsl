// How much each corner of a triangle counts at a place of it: shade::ReceiverWeights::ofTriangle.

vec3 cornerWeights(vec3 position, vec3 a, vec3 b, vec3 c) {
  vec3 e1 = b - a, e2 = c - a;
  vec3 n = cross(e1, e2);
  float u = dot(cross(e2, n), position - a) / dot(n, n);
  float v = dot(cross(n, e1), position - a) / dot(n, n);
  return vec3(1.0 - u - v, u, v);
}
