#include "lambent/file/temporary_folder.h"

#include <unistd.h>

#include <array>
#include <atomic>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <string>
#include <system_error>
#include <utility>

namespace lambent::file {
namespace {

namespace fs = std::filesystem;

// What is there, where a signal handler can read it: no allocation, no lock. What finds no free slot
// works all the same; only a signal would then leave it behind.
struct Leftover {
  enum State : int { Free, Filling, File, Folder };
  std::atomic<int> state{Free};
  std::array<char, 4096> path{};
};
std::array<Leftover, 16> gLeftovers;  // shared by necessity: signal handlers have no other argument
static_assert(std::atomic<int>::is_always_lock_free);

/// −1: none is free.
int note(const std::string& path, Leftover::State what) {
  if (path.size() >= gLeftovers[0].path.size()) return -1;
  for (std::size_t i = 0; i < gLeftovers.size(); ++i) {
    int expected = Leftover::Free;
    if (!gLeftovers[i].state.compare_exchange_strong(expected, Leftover::Filling)) continue;
    std::memcpy(gLeftovers[i].path.data(), path.c_str(), path.size() + 1);
    gLeftovers[i].state.store(what);
    return int(i);
  }
  return -1;
}

}  // namespace

Result<TemporaryFolder> TemporaryFolder::create() {
  std::error_code error;
  const fs::path parent = fs::temp_directory_path(error);
  std::string name = (parent / "lambent-XXXXXX").string();
  if (!error && !mkdtemp(name.data())) error.assign(errno, std::generic_category());
  if (error)
    return report::badInput("no folder for temporary files can be made in " +
                            (parent.empty() ? "TMPDIR" : parent.string()) + ": " + error.message() +
                            ". TMPDIR names another");
  TemporaryFolder folder;
  folder.path_ = name;
  folder.slots_.push_back(note(name, Leftover::Folder));
  return folder;
}

TemporaryFolder::TemporaryFolder(TemporaryFolder&& other) noexcept
    : path_(std::exchange(other.path_, {})), slots_(std::exchange(other.slots_, {})) {}

TemporaryFolder::~TemporaryFolder() {
  if (path_.empty()) return;
  std::error_code ignored;
  fs::remove_all(path_, ignored);
  for (const int slot : slots_)
    if (slot >= 0) gLeftovers[std::size_t(slot)].state.store(Leftover::Free);
}

fs::path TemporaryFolder::place(std::string_view name) {
  fs::path file = path_ / name;
  slots_.push_back(note(file.string(), Leftover::File));
  return file;
}

void TemporaryFolder::discardAll() noexcept {
  const int saved = errno;
  for (Leftover& each : gLeftovers)
    if (each.state.load() == Leftover::File) unlink(each.path.data());
  for (Leftover& each : gLeftovers)
    if (each.state.load() == Leftover::Folder) rmdir(each.path.data());
  errno = saved;
}

}  // namespace lambent::file
