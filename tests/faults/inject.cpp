// Loaded before the tool (LD_PRELOAD): counts what a run asks the system for, and lets one of these
// requests fail, or all from one on. What it is told stands in the environment:
//
//   LAMBENT_FAULT=KIND:N        the N-th of that kind fails, from 1
//   LAMBENT_FAULT=KIND:N+       the N-th and all that follow
//   LAMBENT_FAULT=count         nothing fails; every request of kind `alloc` is a line of the log
//   LAMBENT_FAULT_ERROR=NAME    of `file` and `read`: ENOSPC, EIO (if nothing is said), EINTR, or
//                               `short`: a write takes half of its bytes, as the system may
//   LAMBENT_FAULT_LEAST=BYTES   smaller allocations are not counted
//   LAMBENT_FAULT_EXEMPT=A,B    allocations that these libraries ask for themselves do not fail
//   LAMBENT_FAULT_LOG=FILE      gets what was counted, what failed, and on whose behalf
//
// KIND is `alloc` (malloc and its relatives, so operator new as well), `file` (all that changes
// files: write, sync, open to write, close, rename, link, truncate, mkdir, and stdio's writes) or
// `read` (open to read, read). Counted from the beginning of main() on: what the loader and static
// constructors ask for is not the tool's.
//
// Nothing in here allocates, and it may be called from any thread.
#include <dlfcn.h>
#include <fcntl.h>
#include <link.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <sys/uio.h>
#include <unistd.h>
#include <unwind.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstdarg>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>

// glibc's own, under the names that nobody replaces.
extern "C" {
void* __libc_malloc(size_t size);
void* __libc_calloc(size_t count, size_t size);
void* __libc_realloc(void* old, size_t size);
void* __libc_memalign(size_t alignment, size_t size);
}

namespace {

enum Kind : int { Alloc, File, Read, kKinds };
constexpr std::array<const char*, kKinds> kNames{"alloc", "file", "read"};

std::atomic<bool> gBegun{false};
std::array<std::atomic<std::uint64_t>, kKinds> gCounts{};
// Written before main() begins, read afterwards.
int gKind = -1;
std::uint64_t gFirst = 0;
bool gAndAfter = false, gCounting = false, gShort = false;
int gError = EIO, gLog = -1;
size_t gLeast = 0;
std::array<char, 256> gExempt{};
int (*gMain)(int, char**, char**) = nullptr;

// In the log's own code requests pass.
thread_local bool tInside __attribute__((tls_model("initial-exec"))) = false;

class Inside {
 public:
  Inside() : errno_(errno) { tInside = true; }
  ~Inside() {
    tInside = false;
    errno = errno_;
  }
  Inside(const Inside&) = delete;
  Inside& operator=(const Inside&) = delete;

 private:
  int errno_;
};

__attribute__((format(printf, 1, 2))) void log(const char* format, ...) {
  if (gLog < 0) return;
  std::array<char, 512> line;
  va_list arguments;
  va_start(arguments, format);
  const int length = std::vsnprintf(line.data(), line.size(), format, arguments);
  va_end(arguments);
  if (length > 0)
    syscall(SYS_write, gLog, line.data(), std::min<size_t>(size_t(length), line.size() - 1));
}

struct Stack {
  std::array<std::uintptr_t, 32> places{};
  size_t size = 0;

  static _Unwind_Reason_Code add(_Unwind_Context* context, void* to) {
    Stack& stack = *static_cast<Stack*>(to);
    if (stack.size == stack.places.size()) return _URC_END_OF_STACK;
    stack.places[stack.size++] = _Unwind_GetIP(context);
    return _URC_NO_REASON;
  }
  static Stack take() {
    Stack stack;
    _Unwind_Backtrace(add, &stack);
    return stack;
  }
  std::uint64_t hash() const {
    std::uint64_t h = 14695981039346656037u;
    for (size_t i = 0; i < size; ++i) h = (h ^ places[i]) * 1099511628211u;
    return h;
  }
};

struct Place {
  const char* library = "?";
  std::uintptr_t offset = 0;
  const void* base = nullptr;
};

Place placeOf(std::uintptr_t address) {
  Dl_info info;
  if (!dladdr(reinterpret_cast<void*>(address - 1), &info) || !info.dli_fname) return {};
  const char* slash = std::strrchr(info.dli_fname, '/');
  return {slash ? slash + 1 : info.dli_fname,
          address - 1 - reinterpret_cast<std::uintptr_t>(info.dli_fbase), info.dli_fbase};
}

void logPlaces(const Stack& stack) {
  for (size_t i = 0; i < stack.size; ++i) {
    const Place place = placeOf(stack.places[i]);
    log("  %s+0x%llx\n", place.library, static_cast<unsigned long long>(place.offset));
  }
}

/// Whether the one who allocates is in a library of the list: the first place that is neither here
/// nor operator new.
bool isExempt(const Stack& stack) {
  if (!gExempt[0]) return false;
  const void* here = placeOf(reinterpret_cast<std::uintptr_t>(&placeOf) + 1).base;
  for (size_t i = 0; i < stack.size; ++i) {
    const Place place = placeOf(stack.places[i]);
    if (place.base == here || std::strncmp(place.library, "libstdc++", 9) == 0) continue;
    for (const char* name = gExempt.data(); *name;) {
      const size_t length = std::strcspn(name, ",");
      if (length > 0 && std::strncmp(place.library, name, length) == 0) return true;
      name += length + (name[length] == ',');
    }
    return false;
  }
  return false;
}

/// Whether this request is to fail. `what` and `on` are for the log.
bool fails(Kind kind, const char* what, long on) {
  if (!gBegun.load(std::memory_order_acquire) || tInside) return false;
  const std::uint64_t n = ++gCounts[size_t(kind)];
  if (gCounting && kind == Alloc) {
    const Inside inside;
    const Stack stack = Stack::take();
    log("alloc %llu %ld %016llx\n", static_cast<unsigned long long>(n), on,
        static_cast<unsigned long long>(stack.hash()));
    return false;
  }
  if (gCounting) {
    const Inside inside;
    log("%s %llu %s %ld\n", kNames[size_t(kind)], static_cast<unsigned long long>(n), what, on);
    return false;
  }
  if (kind != gKind || n < gFirst || (n > gFirst && !gAndAfter)) return false;
  const Inside inside;
  const bool tell = n == gFirst;
  const Stack stack = tell || gExempt[0] ? Stack::take() : Stack();
  const bool exempt = kind == Alloc && isExempt(stack);
  if (tell) {
    log("%s %s %llu %s %ld\n", exempt ? "exempt" : "failed", kNames[size_t(kind)],
        static_cast<unsigned long long>(n), what, on);
    logPlaces(stack);
  }
  return !exempt;
}

bool allocationFails(const char* what, size_t size) {
  if (size < gLeast || !fails(Alloc, what, static_cast<long>(size))) return false;
  errno = ENOMEM;
  return true;
}

/// Of all requests about files except writes: those fail with an error, or not at all.
bool requestFails(Kind kind, const char* what, long on) {
  if (!fails(kind, what, on) || gShort) return false;
  errno = gError;
  return true;
}

/// How many bytes of a write are to be taken; −1: it fails.
ssize_t taken(const char* what, int descriptor, size_t size) {
  if (!fails(File, what, descriptor)) return static_cast<ssize_t>(size);
  if (gShort) return static_cast<ssize_t>(size > 1 ? size / 2 : size);
  errno = gError;
  return -1;
}

template <class F>
F next(F, const char* name) {
  const Inside inside;
  return reinterpret_cast<F>(dlsym(RTLD_NEXT, name));
}

int errorNamed(const char* name) {
  if (std::strcmp(name, "ENOSPC") == 0) return ENOSPC;
  if (std::strcmp(name, "EINTR") == 0) return EINTR;
  return EIO;
}

void takeOrders() {
  if (const char* name = std::getenv("LAMBENT_FAULT_LOG")) {
    const long file = syscall(SYS_openat, AT_FDCWD, name,
                              O_WRONLY | O_CREAT | O_TRUNC | O_APPEND | O_CLOEXEC, 0666);
    // Out of the way of the numbers that the tool's own files get.
    gLog = static_cast<int>(syscall(SYS_fcntl, file, F_DUPFD_CLOEXEC, 500));
    syscall(SYS_close, file);
  }
  if (const char* error = std::getenv("LAMBENT_FAULT_ERROR")) {
    gShort = std::strcmp(error, "short") == 0;
    gError = errorNamed(error);
  }
  if (const char* least = std::getenv("LAMBENT_FAULT_LEAST"))
    gLeast = std::strtoull(least, nullptr, 10);
  if (const char* exempt = std::getenv("LAMBENT_FAULT_EXEMPT"))
    std::strncpy(gExempt.data(), exempt, gExempt.size() - 1);
  const char* const fault = std::getenv("LAMBENT_FAULT");
  if (!fault) return;
  gCounting = std::strcmp(fault, "count") == 0;
  for (size_t kind = 0; kind < kNames.size(); ++kind) {
    const size_t length = std::strlen(kNames[kind]);
    if (std::strncmp(fault, kNames[kind], length) != 0 || fault[length] != ':') continue;
    char* end = nullptr;
    gKind = static_cast<int>(kind);
    gFirst = std::strtoull(fault + length + 1, &end, 10);
    gAndAfter = *end == '+';
  }
}

/// Where it was that the process ended itself, or was ended.
void tellEnd(const char* how) {
  const Inside inside;
  const Stack stack = Stack::take();
  log("%s\n", how);
  logPlaces(stack);
}

void onCrash(int) {
  tellEnd("crash");  // the default action follows: the same instruction is tried again
}

int mainAfterOrders(int argc, char** argv, char** environment) {
  takeOrders();
  struct sigaction crash = {};
  crash.sa_handler = onCrash;
  crash.sa_flags = static_cast<int>(SA_RESETHAND);
  sigaction(SIGSEGV, &crash, nullptr);
  gBegun.store(true, std::memory_order_release);
  return gMain(argc, argv, environment);
}

__attribute__((destructor)) void tellCounts() {
  gBegun.store(false);
  for (size_t kind = 0; kind < kNames.size(); ++kind)
    log("count %s %llu\n", kNames[kind], static_cast<unsigned long long>(gCounts[kind].load()));
}

/// Standard error does not fail here: what is said there is looked at.
bool isTold(int file) {
  return file == STDERR_FILENO;
}

bool writes(int flags) {
  return (flags & O_ACCMODE) != O_RDONLY || (flags & O_CREAT) != 0;
}

int openOr(const char* what, int folder, const char* path, int flags, mode_t mode) {
  if (requestFails(writes(flags) ? File : Read, what, flags)) return -1;
  return static_cast<int>(syscall(SYS_openat, folder, path, flags, mode));
}

mode_t modeOf(int flags, va_list arguments) {
  return (flags & O_CREAT) != 0 || (flags & O_TMPFILE) == O_TMPFILE
             ? static_cast<mode_t>(va_arg(arguments, int))
             : 0;
}

}  // namespace

extern "C" {

using Start = int (*)(int (*)(int, char**, char**), int, char**, void (*)(), void (*)(), void (*)(),
                      void*);

int __libc_start_main(int (*mainFunction)(int, char**, char**), int argc, char** argv,
                      void (*begin)(), void (*end)(), void (*loader)(), void* stackEnd) {
  gMain = mainFunction;
  const Start start = next(Start(), "__libc_start_main");
  return start(mainAfterOrders, argc, argv, begin, end, loader, stackEnd);
}

void abort() noexcept {
  static const auto real = next(&abort, "abort");
  tellEnd("abort");
  real();
  __builtin_unreachable();
}

// Memory.

void* malloc(size_t size) noexcept {
  return allocationFails("malloc", size) ? nullptr : __libc_malloc(size);
}
void* calloc(size_t count, size_t size) noexcept {
  return allocationFails("calloc", count * size) ? nullptr : __libc_calloc(count, size);
}
void* realloc(void* old, size_t size) noexcept {
  return size > 0 && allocationFails("realloc", size) ? nullptr : __libc_realloc(old, size);
}
void* reallocarray(void* old, size_t count, size_t size) noexcept {
  size_t bytes = 0;
  if (__builtin_mul_overflow(count, size, &bytes)) {
    errno = ENOMEM;
    return nullptr;
  }
  return realloc(old, bytes);
}
void* memalign(size_t alignment, size_t size) noexcept {
  return allocationFails("memalign", size) ? nullptr : __libc_memalign(alignment, size);
}
void* aligned_alloc(size_t alignment, size_t size) noexcept {
  return allocationFails("aligned_alloc", size) ? nullptr : __libc_memalign(alignment, size);
}
int posix_memalign(void** memory, size_t alignment, size_t size) noexcept {
  const int before = errno;
  void* const got =
      allocationFails("posix_memalign", size) ? nullptr : __libc_memalign(alignment, size);
  errno = before;
  if (!got) return ENOMEM;
  *memory = got;
  return 0;
}

// Files that are written.

ssize_t write(int file, const void* bytes, size_t size) {
  const ssize_t count = isTold(file) ? ssize_t(size) : taken("write", file, size);
  return count < 0 ? -1 : syscall(SYS_write, file, bytes, count);
}
ssize_t pwrite(int file, const void* bytes, size_t size, off_t at) {
  const ssize_t count = taken("pwrite", file, size);
  return count < 0 ? -1 : syscall(SYS_pwrite64, file, bytes, count, at);
}
ssize_t pwrite64(int file, const void* bytes, size_t size, off64_t at) {
  return pwrite(file, bytes, size, at);
}
ssize_t writev(int file, const iovec* parts, int count) {
  const size_t all = 2;  // a write that is cut short takes the first part alone
  const ssize_t some = taken("writev", file, all);
  return some < 0 ? -1 : syscall(SYS_writev, file, parts, some < ssize_t(all) ? 1 : count);
}
// Nothing here looks at what a crash of the machine leaves, and disks take their time.
int fsync(int file) {
  return requestFails(File, "fsync", file) ? -1 : 0;
}
int fdatasync(int file) {
  return requestFails(File, "fdatasync", file) ? -1 : 0;
}
int ftruncate(int file, off_t size) noexcept {
  return requestFails(File, "ftruncate", file)
             ? -1
             : static_cast<int>(syscall(SYS_ftruncate, file, size));
}
int ftruncate64(int file, off64_t size) noexcept {
  return ftruncate(file, size);
}
int close(int file) {
  // The descriptor is gone in any case, as on Linux.
  const bool failing = requestFails(File, "close", file);
  const int error = errno;
  const int closed = static_cast<int>(syscall(SYS_close, file));
  if (failing) errno = error;
  return failing ? -1 : closed;
}
int rename(const char* from, const char* to) noexcept {
  return requestFails(File, "rename", 0) ? -1 : static_cast<int>(syscall(SYS_rename, from, to));
}
int renameat(int fromFolder, const char* from, int toFolder, const char* to) noexcept {
  return requestFails(File, "renameat", 0)
             ? -1
             : static_cast<int>(syscall(SYS_renameat2, fromFolder, from, toFolder, to, 0));
}
int renameat2(int fromFolder, const char* from, int toFolder, const char* to,
              unsigned flags) noexcept {
  return requestFails(File, "renameat2", 0)
             ? -1
             : static_cast<int>(syscall(SYS_renameat2, fromFolder, from, toFolder, to, flags));
}
int link(const char* from, const char* to) noexcept {
  return requestFails(File, "link", 0) ? -1 : static_cast<int>(syscall(SYS_link, from, to));
}
int linkat(int fromFolder, const char* from, int toFolder, const char* to, int flags) noexcept {
  return requestFails(File, "linkat", 0)
             ? -1
             : static_cast<int>(syscall(SYS_linkat, fromFolder, from, toFolder, to, flags));
}
int mkdir(const char* path, mode_t mode) noexcept {
  return requestFails(File, "mkdir", 0) ? -1 : static_cast<int>(syscall(SYS_mkdir, path, mode));
}

// Opened for the one or the other.

int open(const char* path, int flags, ...) {
  va_list arguments;
  va_start(arguments, flags);
  const mode_t mode = modeOf(flags, arguments);
  va_end(arguments);
  return openOr("open", AT_FDCWD, path, flags, mode);
}
int open64(const char* path, int flags, ...) {
  va_list arguments;
  va_start(arguments, flags);
  const mode_t mode = modeOf(flags, arguments);
  va_end(arguments);
  return openOr("open64", AT_FDCWD, path, flags, mode);
}
int openat(int folder, const char* path, int flags, ...) {
  va_list arguments;
  va_start(arguments, flags);
  const mode_t mode = modeOf(flags, arguments);
  va_end(arguments);
  return openOr("openat", folder, path, flags, mode);
}
int openat64(int folder, const char* path, int flags, ...) {
  va_list arguments;
  va_start(arguments, flags);
  const mode_t mode = modeOf(flags, arguments);
  va_end(arguments);
  return openOr("openat64", folder, path, flags, mode);
}
// What hardened builds call.
int __open_2(const char* path, int flags) {
  return openOr("open", AT_FDCWD, path, flags, 0);
}
int __open64_2(const char* path, int flags) {
  return openOr("open64", AT_FDCWD, path, flags, 0);
}

// Files that are read.

ssize_t read(int file, void* bytes, size_t size) {
  return requestFails(Read, "read", file) ? -1 : syscall(SYS_read, file, bytes, size);
}
ssize_t __read_chk(int file, void* bytes, size_t size, size_t) {
  return read(file, bytes, size);
}

// Within libc stdio writes under names that cannot be replaced: its own calls fail in their place.

size_t fwrite(const void* bytes, size_t size, size_t count, FILE* to) {
  static const auto real = next(&fwrite, "fwrite");
  return !isTold(fileno(to)) && requestFails(File, "fwrite", fileno(to))
             ? 0
             : real(bytes, size, count, to);
}
int fputs(const char* text, FILE* to) {
  static const auto real = next(&fputs, "fputs");
  return !isTold(fileno(to)) && requestFails(File, "fputs", fileno(to)) ? EOF : real(text, to);
}
int fflush(FILE* to) {
  static const auto real = next(&fflush, "fflush");
  return to && !isTold(fileno(to)) && requestFails(File, "fflush", fileno(to)) ? EOF : real(to);
}
int fclose(FILE* to) {
  static const auto real = next(&fclose, "fclose");
  const bool failing = requestFails(File, "fclose", fileno(to));
  const int error = errno;
  const int closed = real(to);
  if (failing) errno = error;
  return failing ? EOF : closed;
}

}  // extern "C"
