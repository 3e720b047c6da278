// Shading 50,000 receivers on one thread. Each case prints the rate at which whole meshes are
// shaded (`frames`) and `of_read`: that rate over the one at which this machine, in the same run,
// merely reads as many bytes of transfer from where they lie.

#include <benchmark/benchmark.h>

#include <algorithm>
#include <ctime>
#include <random>

#include "lambent/shade/shade.h"
#include "lambent/shade/transfer_matrices.h"
#include "lambent/work/thread_limit.h"

namespace lambent::shade {
namespace {

using transfer::Encoding;

constexpr std::size_t kReceivers = 50'000;

transfer::Numbers numbers(std::size_t count, Encoding encoding) {
  std::mt19937 engine(1);
  std::vector<float> values(count);
  for (float& x : values) x = float(engine()) / float(1u << 31) - 1.0f;
  return transfer::encode(values, encoding);
}

sh::RgbCoefficients light(int bands) {
  sh::RgbCoefficients light(bands);
  for (std::size_t i = 0; i < light.values.size(); ++i) light.values[i] = 1.0f / float(i + 1);
  return light;
}

/// This thread's own time, so that what else the machine does is left out.
double threadSeconds() {
  timespec time{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return double(time.tv_sec) + 1e-9 * double(time.tv_nsec);
}

/// Seconds to read `bytes` that were read before, by sums that the compiler turns into vector
/// loads: the best of some repetitions.
double readSeconds(std::size_t bytes) {
  std::vector<std::uint64_t> memory(bytes / 8 + 1, 1);
  double best = 1e9;
  for (int repetition = 0; repetition < 20; ++repetition) {
    const double start = threadSeconds();
    std::uint64_t sums[8] = {};
    for (std::size_t i = 0; i + 8 <= memory.size(); i += 8)
      for (int k = 0; k < 8; ++k) sums[k] += memory[i + k];
    benchmark::DoNotOptimize(sums);
    best = std::min(best, threadSeconds() - start);
  }
  return best;
}

void report(benchmark::State& state, double seconds, std::size_t bytes) {
  state.counters["frames"] =
      benchmark::Counter(double(state.iterations()), benchmark::Counter::kIsRate);
  state.counters["of_read"] = readSeconds(bytes) * double(state.iterations()) / seconds;
  state.SetBytesProcessed(std::int64_t(state.iterations()) * std::int64_t(bytes));
}

void diffuse(benchmark::State& state, int bands, int channels, Encoding encoding) {
  const DiffuseShader shader(
      {bands, channels, numbers(kReceivers * channels * sh::coefficientCount(bands), encoding)});
  const sh::RgbCoefficients l = light(bands);
  std::vector<float> out(3 * kReceivers);
  const double start = threadSeconds();
  for ([[maybe_unused]] auto _ : state) {
    shader.shade(l, out);
    benchmark::ClobberMemory();
  }
  const double seconds = threadSeconds() - start;
  report(state, seconds,
         kReceivers * channels * sh::coefficientCount(bands) *
             (encoding == Encoding::Float16 ? 2 : 4));
}

void glossy(benchmark::State& state, int outBands, int inBands, int channels, Encoding encoding) {
  const work::ThreadLimit oneThread(1);
  const transfer::Matrices<transfer::Numbers> m{
      outBands, inBands, channels,
      numbers(
          kReceivers * channels * sh::coefficientCount(outBands) * sh::coefficientCount(inBands),
          encoding)};
  const sh::RgbCoefficients l = light(inBands);
  const double start = threadSeconds();
  for ([[maybe_unused]] auto _ : state) benchmark::DoNotOptimize(applyMatrices(m, l).data());
  const double seconds = threadSeconds() - start;
  report(state, seconds,
         kReceivers * channels * sh::coefficientCount(outBands) * sh::coefficientCount(inBands) *
             (encoding == Encoding::Float16 ? 2 : 4));
}

BENCHMARK_CAPTURE(diffuse, 5_bands_grey_half, 5, 1, Encoding::Float16);
BENCHMARK_CAPTURE(diffuse, 5_bands_grey_single, 5, 1, Encoding::Float32);
BENCHMARK_CAPTURE(diffuse, 5_bands_rgb_half, 5, 3, Encoding::Float16);
BENCHMARK_CAPTURE(diffuse, 5_bands_rgb_single, 5, 3, Encoding::Float32);
BENCHMARK_CAPTURE(diffuse, 3_bands_rgb_half, 3, 3, Encoding::Float16);
BENCHMARK_CAPTURE(glossy, 25x25_grey_half, 5, 5, 1, Encoding::Float16)
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(glossy, 25x25_grey_single, 5, 5, 1, Encoding::Float32)
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(glossy, 25x9_grey_half, 5, 3, 1, Encoding::Float16)
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(glossy, 25x25_rgb_half, 5, 5, 3, Encoding::Float16)
    ->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace lambent::shade

BENCHMARK_MAIN();
