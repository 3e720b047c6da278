// Radiance that reaches receivers, M L, times a factor for each row: the product of
// transfer_matrices.comp.glsl and, with one row, transfer_vectors.comp.glsl
// (sloan2002precomputed eq. 8, 9 and 12; sloan2003biscale eq. 4).
//
// Before this text stand: #define LAMBENT_ROWS, of the result; LAMBENT_TEXELS that a receiver takes;
// LAMBENT_STORED_ROWS of a matrix; LAMBENT_QUADS, the columns in groups of four; LAMBENT_CHANNELS 1
// or 3; LAMBENT_SCALED 0 or 1; row_place.glsl. After it: pass_main.glsl.

uniform sampler2DArray numbers;
uniform ivec3 numbersRows;
#if LAMBENT_SCALED
uniform sampler2DArray scales;  // one for each matrix
uniform ivec3 scalesRows;
#endif
uniform vec4 light[3 * LAMBENT_QUADS];  // [channel][column], four in one
uniform vec4 factors[(LAMBENT_ROWS + 3) / 4];
uniform vec3 reflectance;
uniform int step_;  // 0: all receivers share one matrix

int matrix;
vec3 scale;

float scaleOf(int index) {
#if LAMBENT_SCALED
  return texelFetch(scales, rowPlace(scalesRows, index), 0).x;
#else
  return 1.0;
#endif
}

void begin(int receiver) {
  matrix = receiver * step_ * LAMBENT_CHANNELS;
#if LAMBENT_CHANNELS == 1
  scale = vec3(scaleOf(matrix));
#else
  scale = vec3(scaleOf(matrix), scaleOf(matrix + 1), scaleOf(matrix + 2));
#endif
}

vec3 result(int i) {
  if (i >= LAMBENT_STORED_ROWS) return vec3(0.0);
  vec3 sum = vec3(0.0);
  ivec3 from = rowPlace(numbersRows, matrix * LAMBENT_STORED_ROWS + i);
#if LAMBENT_CHANNELS == 1
  for (int j = 0; j < LAMBENT_QUADS; ++j) {
    vec4 m = texelFetch(numbers, from + ivec3(j, 0, 0), 0);
    sum += vec3(dot(m, light[j]), dot(m, light[LAMBENT_QUADS + j]),
                dot(m, light[2 * LAMBENT_QUADS + j]));
  }
#else
  ivec3 green = rowPlace(numbersRows, (matrix + 1) * LAMBENT_STORED_ROWS + i);
  ivec3 blue = rowPlace(numbersRows, (matrix + 2) * LAMBENT_STORED_ROWS + i);
  for (int j = 0; j < LAMBENT_QUADS; ++j) {
    ivec3 on = ivec3(j, 0, 0);
    sum += vec3(dot(texelFetch(numbers, from + on, 0), light[j]),
                dot(texelFetch(numbers, green + on, 0), light[LAMBENT_QUADS + j]),
                dot(texelFetch(numbers, blue + on, 0), light[2 * LAMBENT_QUADS + j]));
  }
#endif
  return sum * scale * reflectance * factors[i >> 2][i & 3];
}
