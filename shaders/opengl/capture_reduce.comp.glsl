// L_i = E_i + Σ_texels B_i · (mean of the texel's sub-texels): a work group for each sample
// (sloan2002precomputed §6.2). E is the environment, B the basis functions weighted by solid angle
// (capture::cubeWeights), and the pictures hold the difference that bodies make.

layout(local_size_x = 128) in;

layout(std430, binding = 0) readonly buffer Weights { float weights[]; };  // [texel][coefficient]
layout(std430, binding = 1) readonly buffer Environment { float environment[]; };  // [coefficient][3]
layout(std430, binding = 2) writeonly buffer Light { float light[]; };  // [sample][coefficient][3]

layout(binding = 0) uniform sampler2D drawn;  // tiles as capture_faces.vert.glsl lays them out

uniform int size;           // texels along the edge of a face, as they are projected
uniform int supersampling;  // each is the mean of this many a side
uniform int coefficients;   // at most 128
uniform int environmentCoefficients;
uniform int tilesAcross;

const int kThreads = 128;
const int kChunk = 512;
shared vec3 texels[kChunk];
shared vec3 partial[kThreads];

vec3 texelMean(int texel) {
  int face = texel / (size * size), within = texel % (size * size);
  int tile = int(gl_WorkGroupID.x) * 6 + face;
  ivec2 corner = supersampling * (size * ivec2(tile % tilesAcross, tile / tilesAcross) +
                                  ivec2(within % size, within / size));
  vec3 sum = vec3(0.0);
  for (int j = 0; j < supersampling; ++j)
    for (int i = 0; i < supersampling; ++i) sum += texelFetch(drawn, corner + ivec2(i, j), 0).rgb;
  return sum / float(supersampling * supersampling);
}

// Threads share the work as [slice][coefficient]; neighbours read neighbouring weights.
void main() {
  int thread = int(gl_LocalInvocationID.x);
  int slices = kThreads / coefficients;
  int slice = thread / coefficients, coefficient = thread % coefficients;
  int count = 6 * size * size;
  vec3 sum = vec3(0.0);
  for (int first = 0; first < count; first += kChunk) {
    int many = min(kChunk, count - first);
    for (int t = thread; t < many; t += kThreads) texels[t] = texelMean(first + t);
    barrier();
    if (slice < slices)
      for (int t = slice; t < many; t += slices)
        sum += weights[(first + t) * coefficients + coefficient] * texels[t];
    barrier();
  }
  partial[thread] = sum;
  barrier();
  if (thread >= coefficients) return;
  vec3 total = vec3(0.0);
  if (thread < environmentCoefficients)
    total = vec3(environment[3 * thread], environment[3 * thread + 1], environment[3 * thread + 2]);
  for (int s = 0; s < slices; ++s) total += partial[s * coefficients + thread];
  int at = (int(gl_WorkGroupID.x) * coefficients + thread) * 3;
  light[at] = total.r;
  light[at + 1] = total.g;
  light[at + 2] = total.b;
}
