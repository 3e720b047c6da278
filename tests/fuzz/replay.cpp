// lambent_fuzz_replay TARGET PLACE…: runs a target over the files that lie in these places, without
// a fuzzer: what once did harm must not do it again.
#include <sys/resource.h>

#include <algorithm>
#include <cstring>
#include <exception>
#include <filesystem>
#include <iterator>
#include <string>
#include <vector>

#include "lambent/file/atomic_file.h"
#include "lambent/work/thread_limit.h"
#include "tests/fuzz/target.h"

namespace {

using namespace lambent;

struct Named {
  const char* name;
  fuzz::Target* run;
};
constexpr Named kTargets[] = {{"gltf", fuzz::gltf},     {"obj", fuzz::obj},
                              {"ply", fuzz::ply},       {"asset", fuzz::asset},
                              {"rtt", fuzz::rtt},       {"exr", fuzz::exr},
                              {"hdr", fuzz::hdr},       {"png", fuzz::png},
                              {"jpeg", fuzz::jpeg},     {"webp", fuzz::webp},
                              {"light", fuzz::light},   {"view", fuzz::view},
                              {"source", fuzz::source}, {"atmosphere", fuzz::atmosphere},
                              {"uri", fuzz::uri},       {"curves", fuzz::curves}};

/// As much as a fuzzer's process may hold; sanitizers keep what was freed for a while.
constexpr long kMostKibibytes = 1 << 20;

struct Input {
  std::string path;
  std::vector<std::byte> bytes;
};

/// Every file in these places and below, read before a target changes the current folder.
std::vector<Input> inputsIn(int count, char** places) {
  std::vector<std::string> paths;
  for (int i = 0; i < count; ++i) {
    if (!std::filesystem::is_directory(places[i])) continue;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(places[i])) {
      if (entry.is_regular_file()) paths.push_back(entry.path().string());
    }
  }
  std::sort(paths.begin(), paths.end());
  std::vector<Input> inputs;
  for (const std::string& path : paths) {
    Result<std::vector<std::byte>> bytes = file::readWhole(path);
    fuzz::require(bool(bytes), "an input can be read");
    inputs.push_back({path, std::move(*bytes)});
  }
  return inputs;
}

}  // namespace

int main(int argc, char** argv) {
  const auto* const target = std::find_if(
      std::begin(kTargets), std::end(kTargets),
      [&](const Named& each) { return argc > 2 && std::strcmp(each.name, argv[1]) == 0; });
  if (target == std::end(kTargets)) {
    std::fprintf(stderr, "usage: lambent_fuzz_replay TARGET FOLDER...\n");
    return 2;
  }
  const work::ThreadLimit one(1);
  const std::vector<Input> inputs = inputsIn(argc - 2, argv + 2);
  for (const Input& input : inputs) {
    // Said before: a crash leaves no time for it.
    std::printf("%s\n", input.path.c_str());
    std::fflush(stdout);
    try {
      target->run(input.bytes);
    } catch (const std::exception& problem) {
      std::printf("left by an exception: %s\n", problem.what());
      return 1;
    }
  }
  rusage used = {};
  getrusage(RUSAGE_SELF, &used);
  std::printf("%zu inputs, %ld MiB at most\n", inputs.size(), used.ru_maxrss / 1024);
  if (inputs.empty() || used.ru_maxrss > kMostKibibytes) {
    std::printf(inputs.empty() ? "no inputs\n" : "too much memory\n");
    return 1;
  }
  return 0;
}
