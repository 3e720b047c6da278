// A body looks the same from everywhere in front of it, and is black from behind.
//
// The planes of the picture were fitted to an asset, and what is around it reaches beyond them.
// Depths there, and in the last hundredth before the planes, are bent so that all of them fit in
// between, still in their sequence; elsewhere they are what the asset's are.

uniform vec3 radiance;

in vec2 depthAndW;

layout(location = 0) out vec4 color;

const float kBent = 0.005;  // of the range of depths, at either end

void main() {
  float depth = 0.5 * depthAndW.x / depthAndW.y + 0.5;
  if (depth < kBent)
    depth = kBent / (2.0 - depth / kBent);
  else if (depth > 1.0 - kBent)
    depth = 1.0 - kBent / (2.0 - (1.0 - depth) / kBent);
  gl_FragDepth = depth;
  color = vec4(gl_FrontFacing ? radiance : vec3(0.0), 1.0);
}
