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
#include "lambent/math/types.h"
#include "lambent/report/finding.h"
#include "lambent/report/progress.h"
#include "lambent/report/result.h"

namespace lambent::sky {
class AirTable;
}

namespace lambent::viewer {

struct LoadedAsset {
  std::filesystem::path path;
  std::unique_ptr<asset::Asset> asset;
};

struct LoadedEnvironment {
  std::string source;
  light::Environment environment;
  Findings findings;
  bool underTheHand = false;  ///< asked for by readSky()
};

/// The air of the sky in a SOURCE.
struct LoadedAir {
  std::string source;
  std::shared_ptr<const sky::AirTable> table;
  Mat3d worldFromSun;
  Findings findings;
};

using Loaded = std::variant<LoadedAsset, LoadedEnvironment, LoadedAir>;

/// Reads one after the other, in the sequence in which it was asked.
class Loader {
 public:
  Loader();
  ~Loader();  ///< waits for the file that is being read

  /// What is read from now on may cost no more, and lie nowhere else.
  void allow(const asset::ReadOptions& reading);
  void readAsset(std::filesystem::path path);
  void readEnvironment(std::string source);
  /// A SOURCE that is one sky, as it changes under the hand: of those that wait only the last is
  /// made, and a table that is being made for another air is given up. Skies share one maker: one
  /// of the same air as the last takes milliseconds.
  void readSky(std::string source);
  /// The air of a SOURCE's one sky: of those that wait only the last is made. Airs share one maker.
  void readAir(std::string source);

  /// What has been read meanwhile, or what was wrong with it.
  std::optional<Result<Loaded>> take();
  bool busy() const;
  /// "bunny.glb", what is being read, and for how long; empty if nothing is.
  std::string reading() const;
  double seconds() const;
  /// How much of the stage under way is done, 0 … 1, where it tells.
  std::optional<double> share() const;

 private:
  struct Request {
    enum class What { Asset, Environment, Sky, Air };
    What what = What::Asset;
    std::string name;
  };
  /// Whether a later one of its kind makes it needless.
  static bool givesWay(const Request& request) {
    return request.what == Request::What::Sky || request.what == Request::What::Air;
  }
  void work(std::stop_token stop);
  bool goesOn(const Request& request, const ProgressUpdate& update);

  mutable std::mutex mutex_;
  std::condition_variable_any woken_;
  asset::ReadOptions reading_;
  std::deque<Request> requests_;
  std::optional<Request> current_;
  std::optional<double> share_;
  std::chrono::steady_clock::time_point began_;
  std::deque<Result<Loaded>> results_;
  std::jthread thread_;  // last: it ends before what it uses goes
};

/// As the loader does it. A mesh that is not baked is BadInput with the command that bakes it.
Result<LoadedAsset> readAsset(const std::filesystem::path& path,
                              const asset::ReadOptions& reading = {});

}  // namespace lambent::viewer
