// As much of GLSL as the texts of shaders/ use, in C++: vectors with their swizzles, matrices, the
// functions of the language. Numbers without a suffix are doubles here, so that sums are at times
// more exact than a GPU's.
//
// A test includes the texts in a namespace within lambent::glsl, after glsl_begin.h, and defines
// there what they declare: what a renderer reads from textures and buffers.
#pragma once

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>

namespace lambent::glsl {

using uint = std::uint32_t;

/// Some components of a vector of N. It shares the vector's memory.
template <class V, class T, int N, int... I>
struct Swizzle {
  T of[N];
  operator V() const { return V(of[I]...); }  // NOLINT: as in GLSL
  const Swizzle& operator=(const V& v) {
    int k = 0;
    ((of[I] = v[k++]), ...);
    return *this;
  }
};

template <class T>
struct Vector2 {
  union {
    struct {
      T x, y;
    };
    T of[2];
  };
  Vector2() : of{} {}
  explicit Vector2(T all) : of{all, all} {}
  Vector2(T x0, T y0) : of{x0, y0} {}
  template <class U>
  explicit Vector2(const Vector2<U>& v) : of{T(v.x), T(v.y)} {}
  template <class U, int N, int... I>
  explicit Vector2(const Swizzle<Vector2<U>, U, N, I...>& v) : Vector2(v.operator Vector2<U>()) {}
  T& operator[](int i) { return of[i]; }
  T operator[](int i) const { return of[i]; }
};

template <class T>
struct Vector3 {
  union {
    struct {
      T x, y, z;
    };
    struct {
      T r, g, b;
    };
    T of[3];
    Swizzle<Vector2<T>, T, 3, 0, 1> xy;
    Swizzle<Vector2<T>, T, 3, 0, 2> xz;
  };
  Vector3() : of{} {}
  explicit Vector3(T all) : of{all, all, all} {}
  Vector3(T x0, T y0, T z0) : of{x0, y0, z0} {}
  Vector3(const Vector2<T>& v, T z0) : of{v.x, v.y, z0} {}
  T& operator[](int i) { return of[i]; }
  T operator[](int i) const { return of[i]; }
};

template <class T>
struct Vector4 {
  union {
    struct {
      T x, y, z, w;
    };
    struct {
      T r, g, b, a;
    };
    T of[4];
    Swizzle<Vector2<T>, T, 4, 0, 1> xy;
    Swizzle<Vector3<T>, T, 4, 0, 1, 2> xyz;
    Swizzle<Vector3<T>, T, 4, 0, 1, 2> rgb;
  };
  Vector4() : of{} {}
  explicit Vector4(T all) : of{all, all, all, all} {}
  Vector4(T x0, T y0, T z0, T w0) : of{x0, y0, z0, w0} {}
  Vector4(const Vector2<T>& u, const Vector2<T>& v) : of{u.x, u.y, v.x, v.y} {}
  Vector4(const Vector3<T>& v, T w0) : of{v.x, v.y, v.z, w0} {}
  template <class U>
  explicit Vector4(const Vector4<U>& v) : of{T(v.x), T(v.y), T(v.z), T(v.w)} {}
  T& operator[](int i) { return of[i]; }
  T operator[](int i) const { return of[i]; }
};

using vec2 = Vector2<float>;
using vec3 = Vector3<float>;
using vec4 = Vector4<float>;
using ivec2 = Vector2<int>;
using ivec3 = Vector3<int>;
using ivec4 = Vector4<int>;
using uvec2 = Vector2<uint>;
using uvec4 = Vector4<uint>;
using bvec2 = Vector2<bool>;
using bvec3 = Vector3<bool>;

// Operators and functions by components. No templates: they take swizzles as well.
template <class V, class F>
V each(F f) {
  V out;
  for (int i = 0; i < int(sizeof(V) / sizeof(out.of[0])); ++i) out[i] = f(i);
  return out;
}

#define LAMBENT_GLSL_OPERATOR(V, T, OP)                  \
  inline V operator OP(const V& a, const V& b) {         \
    return each<V>([&](int i) { return a[i] OP b[i]; }); \
  }                                                      \
  inline V operator OP(const V& a, T b) {                \
    return each<V>([&](int i) { return a[i] OP b; });    \
  }                                                      \
  inline V operator OP(T a, const V& b) {                \
    return each<V>([&](int i) { return a OP b[i]; });    \
  }                                                      \
  inline V& operator OP##=(V& a, const V& b) {           \
    return a = a OP b;                                   \
  }                                                      \
  inline V& operator OP##=(V& a, T b) {                  \
    return a = a OP b;                                   \
  }

#define LAMBENT_GLSL_ARITHMETIC(V, T)             \
  LAMBENT_GLSL_OPERATOR(V, T, +)                  \
  LAMBENT_GLSL_OPERATOR(V, T, -)                  \
  LAMBENT_GLSL_OPERATOR(V, T, *)                  \
  LAMBENT_GLSL_OPERATOR(V, T, /)                  \
  inline V operator-(const V& a) {                \
    return each<V>([&](int i) { return -a[i]; }); \
  }

LAMBENT_GLSL_ARITHMETIC(vec2, float)
LAMBENT_GLSL_ARITHMETIC(vec3, float)
LAMBENT_GLSL_ARITHMETIC(vec4, float)
LAMBENT_GLSL_ARITHMETIC(ivec2, int)
LAMBENT_GLSL_ARITHMETIC(ivec4, int)
LAMBENT_GLSL_OPERATOR(ivec2, int, %)

inline ivec4 operator>>(const ivec4& a, int bits) {
  return each<ivec4>([&](int i) { return a[i] >> bits; });
}

// Of one number.
inline float sqrt(float x) {
  return std::sqrt(x);
}
inline float floor(float x) {
  return std::floor(x);
}
inline float ceil(float x) {
  return std::ceil(x);
}
inline float exp(float x) {
  return std::exp(x);
}
inline float log(float x) {
  return std::log(x);
}
inline float log2(float x) {
  return std::log2(x);
}
inline float pow(float x, float y) {
  return std::pow(x, y);
}
inline float abs(float x) {
  return std::fabs(x);
}
inline float atan(float x) {
  return std::atan(x);
}
inline float atan(float y, float x) {
  return std::atan2(y, x);
}
inline float min(float a, float b) {
  return b < a ? b : a;
}
inline float max(float a, float b) {
  return a < b ? b : a;
}
inline float clamp(float x, float low, float high) {
  return min(max(x, low), high);
}
inline float fract(float x) {
  return x - std::floor(x);
}
inline float mix(float a, float b, float share) {
  return a * (1.0f - share) + b * share;
}
inline int min(int a, int b) {
  return std::min(a, b);
}
inline int max(int a, int b) {
  return std::max(a, b);
}
inline int clamp(int x, int low, int high) {
  return min(max(x, low), high);
}

#define LAMBENT_GLSL_FUNCTIONS(V, B)                                             \
  inline float dot(const V& a, const V& b) {                                     \
    float sum = 0.0f;                                                            \
    for (int i = 0; i < int(sizeof(V) / sizeof(float)); ++i) sum += a[i] * b[i]; \
    return sum;                                                                  \
  }                                                                              \
  inline float length(const V& a) {                                              \
    return std::sqrt(dot(a, a));                                                 \
  }                                                                              \
  inline V normalize(const V& a) {                                               \
    return a / length(a);                                                        \
  }                                                                              \
  inline V floor(const V& a) {                                                   \
    return each<V>([&](int i) { return std::floor(a[i]); });                     \
  }                                                                              \
  inline V exp(const V& a) {                                                     \
    return each<V>([&](int i) { return std::exp(a[i]); });                       \
  }                                                                              \
  inline V abs(const V& a) {                                                     \
    return each<V>([&](int i) { return std::abs(a[i]); });                       \
  }                                                                              \
  inline V fract(const V& a) {                                                   \
    return a - floor(a);                                                         \
  }                                                                              \
  inline V clamp(const V& a, float low, float high) {                            \
    return each<V>([&](int i) { return clamp(a[i], low, high); });               \
  }                                                                              \
  inline V clamp(const V& a, const V& low, const V& high) {                      \
    return each<V>([&](int i) { return clamp(a[i], low[i], high[i]); });         \
  }                                                                              \
  inline V max(const V& a, const V& b) {                                         \
    return each<V>([&](int i) { return max(a[i], b[i]); });                      \
  }                                                                              \
  inline V pow(const V& a, const V& b) {                                         \
    return each<V>([&](int i) { return pow(a[i], b[i]); });                      \
  }                                                                              \
  inline V mix(const V& a, const V& b, float share) {                            \
    return a * (1.0f - share) + b * share;                                       \
  }                                                                              \
  inline V mix(const V& a, const V& b, const B& second) {                        \
    return each<V>([&](int i) { return second[i] ? b[i] : a[i]; });              \
  }                                                                              \
  inline B lessThanEqual(const V& a, const V& b) {                               \
    return each<B>([&](int i) { return a[i] <= b[i]; });                         \
  }

LAMBENT_GLSL_FUNCTIONS(vec2, bvec2)
LAMBENT_GLSL_FUNCTIONS(vec3, bvec3)

inline ivec2 min(const ivec2& a, const ivec2& b) {
  return each<ivec2>([&](int i) { return min(a[i], b[i]); });
}
inline ivec2 min(const ivec2& a, int b) {
  return min(a, ivec2(b));
}

inline vec3 cross(const vec3& a, const vec3& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

struct mat3 {
  vec3 column[3];
  mat3() = default;
  mat3(const vec3& a, const vec3& b, const vec3& c) : column{a, b, c} {}
  vec3& operator[](int i) { return column[i]; }
  const vec3& operator[](int i) const { return column[i]; }
};
inline vec3 operator*(const mat3& m, const vec3& v) {
  return m[0] * v.x + m[1] * v.y + m[2] * v.z;
}
inline vec3 operator*(const vec3& v, const mat3& m) {
  return {dot(v, m[0]), dot(v, m[1]), dot(v, m[2])};
}

// Bits.
inline vec4 uintBitsToFloat(const uvec4& words) {
  return each<vec4>([&](int i) { return std::bit_cast<float>(words[i]); });
}
inline float floatFromHalfBits(uint half) {
  const int exponent = int(half >> 10 & 31), mantissa = int(half & 1023);
  const float size = exponent == 0 ? std::ldexp(float(mantissa), -24)
                                   : std::ldexp(float(1024 + mantissa), exponent - 25);
  return half >> 15 & 1 ? -size : size;
}
inline vec2 unpackHalf2x16(uint word) {
  return {floatFromHalfBits(word & 0xffff), floatFromHalfBits(word >> 16)};
}

/// A texture of which single texels are read.
struct Picture {
  ivec2 size;
  const float* rgb;  ///< [y][x][3]
};
using sampler2D = const Picture*;
inline ivec2 textureSize(sampler2D picture, int) {
  return picture->size;
}

}  // namespace lambent::glsl
