// What the benchmarks that are programs of their own share: figures printed as they are measured,
// and kept as CSV: name, value, unit, wanted.
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "lambent/report/result.h"

namespace lambent::bench {

/// A benchmark ends with the error of what it measures.
template <class T>
T valueOf(Result<T> result) {
  if (result) return std::move(*result);
  fmt::print(stderr, "{}\n", result.error().message);
  std::exit(1);
}

inline void expectOk(const Status& status) {
  if (status) return;
  fmt::print(stderr, "{}\n", status.error().message);
  std::exit(1);
}

inline double now() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

struct Figure {
  std::string name;
  double value;
  std::string unit, wanted;
};

inline std::vector<Figure>& figures() {
  static std::vector<Figure> all;
  return all;
}

inline void note(const std::string& name, double value, const std::string& unit,
                 const std::string& wanted = "") {
  figures().push_back({name, value, unit, wanted});
  fmt::print("{:<64} {:>10.4g} {:<10} {}\n", name, value, unit,
             wanted.empty() ? "" : "wanted " + wanted);
  std::fflush(stdout);
}

/// `device`: where it was measured, as a column of its own; empty: none.
inline void writeFigures(const std::filesystem::path& csv, const std::string& device = "") {
  if (csv.empty()) return;
  std::ofstream file(csv);
  file << "name,value,unit,wanted" << (device.empty() ? "" : ",device") << "\n";
  for (const Figure& f : figures()) {
    file << fmt::format("\"{}\",{:.6g},{},{}", f.name, f.value, f.unit, f.wanted);
    if (!device.empty()) file << fmt::format(",\"{}\"", device);
    file << "\n";
  }
}

/// Times several jobs alternately, so that they share the machine's moods; the best of each.
inline std::vector<double> bestOf(int rounds, const std::vector<std::function<void()>>& jobs) {
  std::vector<double> best(jobs.size(), 1e30);
  for (int round = 0; round < rounds; ++round)
    for (std::size_t j = 0; j < jobs.size(); ++j) {
      const double start = now();
      jobs[j]();
      best[j] = std::min(best[j], now() - start);
    }
  return best;
}

}  // namespace lambent::bench
