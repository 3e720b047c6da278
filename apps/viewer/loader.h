// Files are read on a thread of their own, so that the window stays alive.
#pragma once

#include <chrono>
#include <condition_variable>
#include <deque>
#include <filesystem>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <variant>

#include "lambent/asset/read.h"
#include "lambent/light/environment.h"
#include "lambent/report/finding.h"
#include "lambent/report/result.h"

namespace lambent::viewer {

struct LoadedAsset {
  std::filesystem::path path;
  std::unique_ptr<asset::Asset> asset;
};

struct LoadedEnvironment {
  std::string source;
  light::Environment environment;
  Findings findings;
};

using Loaded = std::variant<LoadedAsset, LoadedEnvironment>;

/// Reads one after the other, in the sequence in which it was asked.
class Loader {
 public:
  Loader();
  ~Loader();  ///< waits for the file that is being read

  /// What is read from now on may cost no more, and lie nowhere else.
  void allow(const asset::ReadOptions& reading);
  void readAsset(std::filesystem::path path);
  void readEnvironment(std::string source);

  /// What has been read meanwhile, or what was wrong with it.
  std::optional<Result<Loaded>> take();
  bool busy() const;
  /// "bunny.glb", what is being read, and for how long; empty if nothing is.
  std::string reading() const;
  double seconds() const;

 private:
  struct Request {
    bool asset = false;
    std::string name;
  };
  void work(std::stop_token stop);

  mutable std::mutex mutex_;
  std::condition_variable_any woken_;
  asset::ReadOptions reading_;
  std::deque<Request> requests_;
  std::optional<Request> current_;
  std::chrono::steady_clock::time_point began_;
  std::deque<Result<Loaded>> results_;
  std::jthread thread_;  // last: it ends before what it uses goes
};

/// As the loader does it. A mesh that is not baked is BadInput with the command that bakes it.
Result<LoadedAsset> readAsset(const std::filesystem::path& path,
                              const asset::ReadOptions& reading = {});

}  // namespace lambent::viewer
