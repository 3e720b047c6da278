// Spherical harmonics: nanoseconds a call, one thread, for one vector at a time. The inputs vary
// from call to call and every result is consumed, so that nothing is hoisted or dropped.
#include <benchmark/benchmark.h>

#include <array>
#include <vector>

#include "lambent/math/directions.h"
#include "lambent/math/random.h"
#include "lambent/sh/basis.h"
#include "lambent/sh/product.h"
#include "lambent/sh/rotation.h"

namespace lambent {
namespace {

constexpr int kInputs = 256;  // few enough to stay in the first-level cache, with their results

std::vector<std::array<float, 100>> randomVectors(std::uint64_t seed) {
  std::vector<std::array<float, 100>> vectors(kInputs);
  for (int i = 0; i < kInputs; ++i) {
    math::Random random(seed, std::uint64_t(i));
    for (float& v : vectors[i]) v = 2 * random.uniform() - 1;
  }
  return vectors;
}

void evaluation(benchmark::State& state) {
  const int bands = int(state.range(0));
  const auto count = std::size_t(sh::coefficientCount(bands));
  std::vector<Vec3> directions;
  for (int i = 0; i < kInputs; ++i)
    directions.push_back(math::uniformSphere(math::Random(1, std::uint64_t(i)).uniform2()));
  std::array<float, 100> out{};
  unsigned i = 0;
  for (auto _ : state) {
    sh::evaluate(bands, directions[i++ % kInputs], std::span(out).first(count));
    benchmark::DoNotOptimize(out);
  }
}

void rotation(benchmark::State& state) {
  const int bands = int(state.range(0));
  const auto count = std::size_t(sh::coefficientCount(bands));
  const auto vectors = randomVectors(2);
  std::vector<Mat3> rotations;
  for (std::uint64_t i = 0; i < kInputs; ++i) rotations.push_back(math::randomRotation(i));
  std::array<float, 100> out{};
  unsigned i = 0;
  for (auto _ : state) {
    const unsigned k = i++ % kInputs;
    sh::rotate(bands, rotations[k], std::span(vectors[k]).first(count),
               std::span(out).first(count));
    benchmark::DoNotOptimize(out);
  }
}

void product(benchmark::State& state) {
  const int bands = int(state.range(0));
  const auto count = std::size_t(sh::coefficientCount(bands));
  const auto a = randomVectors(3), b = randomVectors(4);
  std::array<float, 100> out{};
  unsigned i = 0;
  for (auto _ : state) {
    const unsigned k = i++ % kInputs;
    sh::product(bands, std::span(a[k]).first(count), std::span(b[k]).first(count),
                std::span(out).first(count));
    benchmark::DoNotOptimize(out);
  }
}

BENCHMARK(evaluation)->Name("sh/evaluate/bands")->Arg(3)->Arg(5)->Arg(9);
BENCHMARK(rotation)->Name("sh/rotate/bands")->Arg(3)->Arg(5)->Arg(9);
BENCHMARK(product)->Name("sh/product/bands")->Arg(3)->Arg(5)->Arg(9);

}  // namespace
}  // namespace lambent
