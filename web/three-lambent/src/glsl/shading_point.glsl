// The point of a surface that is shaded, from what the rasteriser interpolates; in the asset's frame.
//
// Before this text stands: shading_normal.glsl.

in vec4 positionU;
in vec4 normalV;
in vec3 vertexColor;

uniform vec4 eye;  // position, 1; or, for an orthographic camera, direction to the viewer, 0

struct ShadingPoint {
  vec3 position;
  vec2 uv;
  vec3 normal;    // unit
  vec3 front;     // unit, the triangle's own, on the side that is seen
  vec3 toViewer;  // unit
  float distance;
};

// To be called where all fragments of a quad come along: it takes derivatives.
ShadingPoint shadingPoint() {
  ShadingPoint point;
  point.position = positionU.xyz;
  point.uv = vec2(positionU.w, normalV.w);
  vec3 away = eye.xyz - point.position;
  point.distance = length(away);
  point.toViewer = eye.w > 0.0 ? away / point.distance : eye.xyz;
  vec3 front = cross(dFdx(point.position), dFdy(point.position));
  float size = length(front);
  front = size > 0.0 ? front / size : point.toViewer;
  if (dot(front, point.toViewer) < 0.0) front = -front;
  point.front = front;
  point.normal = shadingNormal(normalV.xyz, front);
  return point;
}
