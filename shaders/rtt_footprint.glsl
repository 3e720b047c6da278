// lambent/shade/rtt_footprint.h in GLSL: where its formulas are explained. A table test holds the
// two together.
//
// Before this text stand: #define LAMBENT_MOST_PROBES, LAMBENT_LEAST_COSINE.

struct Probes {
  float level;
  int count;
  vec2 stride;
};

void footprintAxes(mat3 worldFromPatch, vec3 toViewer, float width, out vec3 longer,
                   out vec3 shorter) {
  float across = length(toViewer.xy);
  vec2 along = across > 1e-6 ? toViewer.xy / across : vec2(1.0, 0.0);
  longer = (along.x * worldFromPatch[0] + along.y * worldFromPatch[1]) *
           (width / max(toViewer.z, LAMBENT_LEAST_COSINE));
  shorter = (along.x * worldFromPatch[1] - along.y * worldFromPatch[0]) * width;
}

Probes probesOf(vec2 longer, vec2 shorter, vec2 positions) {
  vec2 along = longer;
  float a = length(longer * positions), b = length(shorter * positions);
  if (b > a) {
    float swapped = a;
    a = b;
    b = swapped;
    along = shorter;
  }
  Probes probes = Probes(0.0, 1, vec2(0.0));
  if (!(a > 1.0)) return probes;
  float width = max(max(b, 1.0), a / float(LAMBENT_MOST_PROBES));
  float beyond = a * a - width * width;
  if (beyond > 0.04 * width * width) {
    probes.count = clamp(int(ceil(a / width)), 2, LAMBENT_MOST_PROBES);
    float n = float(probes.count);
    probes.stride = along * (sqrt(beyond / (n * n - 1.0)) / a);
  }
  probes.level = log2(width);
  return probes;
}
