// The point of a surface that is shaded, from what the rasteriser interpolates; in the asset's frame.
//
// Before this text stands: shading_normal.glsl.

in vec4 positionU;
in vec4 normalV;
in vec3 vertexColor;

uniform mat4 modelViewMatrix;
uniform mat4 projectionMatrix;

vec4 eye;  // position, 1; or, for an orthographic camera, direction to the viewer, 0

// In the frame of whatever object is drawn: any number of objects may share a material.
vec4 eyeOfObject() {
  vec3 a = modelViewMatrix[0].xyz, b = modelViewMatrix[1].xyz, c = modelViewMatrix[2].xyz;
  mat3 rows = mat3(cross(b, c), cross(c, a), cross(a, b));  // of the inverse, times its determinant
  if (projectionMatrix[3][3] == 1.0) {
    vec3 back = vec3(rows[0].z, rows[1].z, rows[2].z) * sign(dot(a, rows[0]));
    return vec4(normalize(back), 0.0);
  }
  return vec4(-(modelViewMatrix[3].xyz * rows) / dot(a, rows[0]), 1.0);
}

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
  eye = eyeOfObject();
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
