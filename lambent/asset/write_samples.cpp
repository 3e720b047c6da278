// lambent_write_samples FOLDER: writes the sample assets of spec/samples.
#include <cstdio>
#include <filesystem>

#include "lambent/asset/samples.h"

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fprintf(stderr, "usage: lambent_write_samples FOLDER\n");
    return 2;
  }
  for (const auto& [name, asset] : lambent::asset::samples()) {
    const std::filesystem::path path = std::filesystem::path(argv[1]) / name;
    if (const lambent::Status status = lambent::asset::write(asset, path); !status) {
      std::fprintf(stderr, "%s\n", status.error().message.c_str());
      return 1;
    }
    std::printf("%s\n", path.c_str());
  }
  return 0;
}
