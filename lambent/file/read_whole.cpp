#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <new>

#include "lambent/file/atomic_file.h"
#include "lambent/file/failure.h"

namespace lambent::file {
namespace {

// A pipe or a device does not say how much will come; /dev/zero never ends.
constexpr size_t kMaxStreamBytes = size_t(4) << 30;

class Descriptor {
 public:
  explicit Descriptor(int number) : number_(number) {}
  ~Descriptor() {
    if (number_ >= 0) close(number_);
  }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  int get() const { return number_; }

 private:
  int number_;
};

}  // namespace

Result<std::vector<std::byte>> readWhole(const std::filesystem::path& path) {
  if (path.empty()) return report::badUsage("the name of the file to read is empty");
  const Descriptor file(open(path.c_str(), O_RDONLY | O_CLOEXEC));
  if (file.get() < 0) return cannot("read", path, errno);
  struct stat status = {};
  if (fstat(file.get(), &status) != 0) return cannot("read", path, errno);
  if (S_ISDIR(status.st_mode)) return cannot("read", path, EISDIR);
  const bool regular = S_ISREG(status.st_mode);
  try {
    // One byte more than the size says, so that the end is seen without growing; files in /proc
    // have size 0 and content all the same.
    std::vector<std::byte> bytes(regular ? static_cast<size_t>(status.st_size) + 1 : 65536);
    size_t used = 0;
    for (;;) {
      if (used == bytes.size()) bytes.resize(std::max<size_t>(2 * bytes.size(), 65536));
      const ssize_t count = ::read(file.get(), bytes.data() + used, bytes.size() - used);
      if (count < 0) {
        if (errno == EINTR) continue;
        return cannot("read", path, errno);
      }
      if (count == 0) break;
      used += static_cast<size_t>(count);
      if (!regular && used > kMaxStreamBytes) return cannot("read", path, EFBIG);
    }
    bytes.resize(used);
    return bytes;
  } catch (const std::bad_alloc&) {
    return cannot("read", path, ENOMEM);
  }
}

}  // namespace lambent::file
