#include "lambent/file/atomic_file.h"

#include <fcntl.h>
#include <pthread.h>
#include <sys/random.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cerrno>
#include <charconv>
#include <csignal>
#include <cstdint>
#include <cstring>
#include <ctime>
#include <utility>

#include "lambent/file/failure.h"

namespace lambent::file {
namespace {

namespace fs = std::filesystem;

// Names of the temporary files that are open, where a signal handler can read them: a fixed table,
// no allocation, no lock. A file that finds no free slot works all the same; only a signal would
// then leave it behind.
struct Slot {
  enum State : int { Free, Filling, Live };
  std::atomic<int> state{Free};
  std::array<char, 4096> path{};
};
std::array<Slot, 64> gSlots;  // shared by necessity: signal handlers have no other argument
static_assert(std::atomic<int>::is_always_lock_free);

int takeSlot(const std::string& path) {
  if (path.size() >= gSlots[0].path.size()) return -1;
  for (size_t i = 0; i < gSlots.size(); ++i) {
    int expected = Slot::Free;
    if (!gSlots[i].state.compare_exchange_strong(expected, Slot::Filling)) continue;
    std::memcpy(gSlots[i].path.data(), path.c_str(), path.size() + 1);
    gSlots[i].state.store(Slot::Live);
    return static_cast<int>(i);
  }
  return -1;
}

void freeSlot(int slot) {
  if (slot >= 0) gSlots[slot].state.store(Slot::Free);
}

// A write past RLIMIT_FSIZE sends SIGXFSZ, which would kill the process before it could clean up.
// Held back in this thread, the same write returns EFBIG; the signal that is then pending is eaten.
class HoldFileSizeSignal {
 public:
  HoldFileSizeSignal() {
    sigemptyset(&set_);
    sigaddset(&set_, SIGXFSZ);
    pthread_sigmask(SIG_BLOCK, &set_, &before_);
  }
  ~HoldFileSizeSignal() {
    const int saved = errno;
    const timespec none{};
    if (!sigismember(&before_, SIGXFSZ)) {
      while (sigtimedwait(&set_, nullptr, &none) > 0) {
      }
    }
    pthread_sigmask(SIG_SETMASK, &before_, nullptr);
    errno = saved;
  }
  HoldFileSizeSignal(const HoldFileSizeSignal&) = delete;
  HoldFileSizeSignal& operator=(const HoldFileSizeSignal&) = delete;

 private:
  sigset_t set_, before_;
};

std::string randomLetters() {
  std::array<std::uint8_t, 6> bytes{};
  if (getrandom(bytes.data(), bytes.size(), 0) != static_cast<ssize_t>(bytes.size())) {
    static std::atomic<std::uint32_t> counter{0};
    const std::uint32_t n = ++counter * 2654435761u ^ static_cast<std::uint32_t>(getpid());
    for (size_t i = 0; i < bytes.size(); ++i) bytes[i] = static_cast<std::uint8_t>(n >> (4 * i));
  }
  std::string letters;
  for (const std::uint8_t b : bytes) letters += "abcdefghijklmnopqrstuvwxyz012345"[b % 32];
  return letters;
}

/// Where a chain of symbolic links ends, so that a link stays a link and its target is replaced.
Result<fs::path> followLinks(const fs::path& path) {
  fs::path at = path;
  for (int depth = 0; depth < 40; ++depth) {
    std::error_code error;
    if (!fs::is_symlink(fs::symlink_status(at, error)) || error) return at;
    const fs::path next = fs::read_symlink(at, error);
    if (error) return cannot("write", path, error.value());
    at = next.is_absolute() ? next : at.parent_path() / next;
  }
  return cannot("write", path, ELOOP);
}

/// N of /dev/stdout, /dev/stderr, /dev/fd/N and /proc/self/fd/N, or −1: those are streams that the
/// process holds already, and a shell that appends (>>) wants its own offset used.
int streamOf(const fs::path& path) {
  const std::string name = path.lexically_normal().string();
  if (name == "/dev/stdout") return STDOUT_FILENO;
  if (name == "/dev/stderr") return STDERR_FILENO;
  for (const std::string_view prefix : {"/dev/fd/", "/proc/self/fd/"}) {
    if (!name.starts_with(prefix)) continue;
    int number = -1;
    const char* const end = name.data() + name.size();
    const auto parsed = std::from_chars(name.data() + prefix.size(), end, number);
    if (parsed.ec == std::errc() && parsed.ptr == end) return number;
  }
  return -1;
}

struct Target {
  fs::path path;          ///< links followed
  int stream = -1;        ///< a descriptor that the process holds
  bool straight = false;  ///< not a regular file: no detour over a temporary one
  bool exists = false;
  struct stat status = {};  ///< if it exists
};

Result<Target> examine(const fs::path& path) {
  if (path.empty()) return report::badUsage("the name of the file to write is empty");
  Target target;
  target.path = path;
  target.stream = streamOf(path);
  if (target.stream >= 0) {
    target.straight = true;
    if (fcntl(target.stream, F_GETFD) < 0) return cannot("write", path, errno);
    return target;
  }
  if (stat(path.c_str(), &target.status) == 0) {
    target.exists = true;
    if (S_ISDIR(target.status.st_mode)) return cannot("write", path, EISDIR);
    if (access(path.c_str(), W_OK) != 0) return cannot("write", path, errno);
    if (!S_ISREG(target.status.st_mode)) {
      target.straight = true;
      return target;
    }
  } else if (errno != ENOENT) {
    return cannot("write", path, errno);
  }
  Result<fs::path> followed = followLinks(path);
  if (!followed) return followed.error();
  target.path = *followed;
  if (!target.path.has_filename()) return cannot("write", path, EISDIR);  // "folder/", absent
  return target;
}

fs::path folderOf(const fs::path& path) {
  return path.has_parent_path() ? path.parent_path() : fs::path(".");
}

Error cannotCreate(const fs::path& path, int error) {
  const fs::path folder = folderOf(path);
  std::error_code ignored;
  if (error == ENOENT && !fs::exists(folder, ignored)) {
    return report::badInput(path.string() + ": cannot be written: the folder " + folder.string() +
                            " does not exist; create it first, or name another");
  }
  if (error == EACCES || error == EPERM) {
    return report::badInput(path.string() +
                            ": cannot be written: no permission to create files in " +
                            folder.string() + " (" + std::strerror(error) + ")");
  }
  return cannot("write", path, error);
}

}  // namespace

Result<AtomicFile> AtomicFile::create(const fs::path& path) {
  const Result<Target> target = examine(path);
  if (!target) return target.error();

  AtomicFile file;
  file.path_ = target->path;
  if (target->straight) {
    file.temporary_ = target->path;
    file.descriptor_ = target->stream >= 0 ? fcntl(target->stream, F_DUPFD_CLOEXEC, 0)
                                           : open(target->path.c_str(), O_WRONLY | O_CLOEXEC);
    if (file.descriptor_ < 0) return cannot("write", path, errno);
    return file;
  }

  // Beside the target, so that the rename stays within one file system. The stem is cut so that the
  // longest legal name still leaves room for the decoration.
  const std::string stem = target->path.filename().string().substr(0, 200);
  for (int attempt = 0; attempt < 100; ++attempt) {
    file.temporary_ = folderOf(target->path) / ("." + stem + "." + randomLetters() + ".tmp");
    if (!target->path.has_parent_path()) file.temporary_ = file.temporary_.filename();
    // Noted before it exists: a signal in between must not leave it behind. Absolute, because a
    // program may change its working folder meanwhile.
    std::error_code ignored;
    file.slot_ = takeSlot(fs::absolute(file.temporary_, ignored).string());
    // 0666 and the kernel applies the umask; mkstemp would give 0600.
    file.descriptor_ =
        open(file.temporary_.c_str(), O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC | O_NOFOLLOW, 0666);
    if (file.descriptor_ >= 0) break;
    const int error = errno;
    freeSlot(std::exchange(file.slot_, -1));
    if (error != EEXIST) return cannotCreate(path, error);
  }
  if (file.descriptor_ < 0) return cannotCreate(path, EEXIST);
  if (target->exists) {
    // The new content takes over the old file's permissions and, where allowed, its owner.
    [[maybe_unused]] const int owner =
        fchown(file.descriptor_, target->status.st_uid, target->status.st_gid);
    [[maybe_unused]] const int mode = fchmod(file.descriptor_, target->status.st_mode & 07777);
  }
  return file;
}

AtomicFile::AtomicFile(AtomicFile&& other) noexcept
    : path_(std::move(other.path_)),
      temporary_(std::move(other.temporary_)),
      descriptor_(std::exchange(other.descriptor_, -1)),
      slot_(std::exchange(other.slot_, -1)) {}

AtomicFile::~AtomicFile() {
  if (descriptor_ < 0) return;
  close(descriptor_);
  if (temporary_ != path_) unlink(temporary_.c_str());
  freeSlot(slot_);
}

Status AtomicFile::write(std::span<const std::byte> bytes) {
  assert(descriptor_ >= 0 && "written after commit");
  const HoldFileSizeSignal hold;
  while (!bytes.empty()) {
    // Linux writes at most 2 GiB − 4 KiB at once and says so by a short count.
    const ssize_t written = ::write(descriptor_, bytes.data(), bytes.size());
    if (written < 0) {
      if (errno == EINTR) continue;
      return cannot("write", path_, errno);
    }
    if (written == 0) return cannot("write", path_, ENOSPC);
    bytes = bytes.subspan(static_cast<size_t>(written));
  }
  return Status::ok();
}

Status AtomicFile::write(std::string_view text) {
  return write(std::as_bytes(std::span(text.data(), text.size())));
}

Status AtomicFile::commit() {
  assert(descriptor_ >= 0 && "committed twice");
  const bool straight = temporary_ == path_;
  const fs::path folderPath = folderOf(path_);  // nothing may throw once the file is in its place
  // A full disk may show only here. Pipes and devices cannot sync: EINVAL is their answer.
  if (fsync(descriptor_) != 0 && errno != EINVAL && errno != ENOTSUP && errno != EROFS) {
    if (!straight) return cannot("write", path_, errno);
  }
  const int closed = close(std::exchange(descriptor_, -1));
  const int closeError = errno;
  if (straight) return closed == 0 ? Status::ok() : cannot("write", path_, closeError);
  if (closed != 0 && closeError != EINTR) {
    unlink(temporary_.c_str());
    freeSlot(std::exchange(slot_, -1));
    return cannot("write", path_, closeError);
  }
  if (rename(temporary_.c_str(), path_.c_str()) != 0) {
    const int error = errno;
    unlink(temporary_.c_str());
    freeSlot(std::exchange(slot_, -1));
    return cannot("write", path_, error);
  }
  freeSlot(std::exchange(slot_, -1));
  // The name itself reaches the disk with its folder. Not every file system offers this; the file
  // is whole either way.
  const int folder = open(folderPath.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (folder >= 0) {
    fsync(folder);
    close(folder);
  }
  return Status::ok();
}

void AtomicFile::discardAll() noexcept {
  const int saved = errno;
  for (Slot& slot : gSlots) {
    if (slot.state.load() == Slot::Live) unlink(slot.path.data());
  }
  errno = saved;
}

Status writeAtomically(const fs::path& path, std::span<const std::byte> bytes) {
  Result<AtomicFile> file = AtomicFile::create(path);
  if (!file) return file.error();
  if (Status status = file->write(bytes); !status) return status;
  return file->commit();
}

Status writeAtomically(const fs::path& path, std::string_view text) {
  return writeAtomically(path, std::as_bytes(std::span(text.data(), text.size())));
}

Status checkWritable(const fs::path& path) {
  const Result<Target> target = examine(path);
  if (!target) return target.error();
  if (target->straight) return Status::ok();  // opening a pipe would wait for its reader
  const Result<AtomicFile> trial = AtomicFile::create(path);
  return trial ? Status::ok() : Status(trial.error());
}

}  // namespace lambent::file
