#include "lambent/file/failure.h"

#include <cerrno>
#include <string>
#include <system_error>

namespace lambent::file {
namespace {

const char* remedy(int error) {
  switch (error) {
    case ENOSPC:
      return "the disk is full: free some space, or name a file on another disk";
    case EDQUOT:
      return "your disk quota is used up: free some space, or name a file on another disk";
    case EFBIG:
      return "the file would grow beyond what the system allows (see ulimit -f)";
    case EISDIR:
      return "it is a folder: name a file in it";
    case ENOENT:
      return "check the spelling of the path";
    case ENOTDIR:
      return "a part of the path is a file, not a folder";
    case EACCES:
    case EPERM:
      return "check the permissions of the file and its folder";
    case EROFS:
      return "name a file on a file system that can be written";
    case ELOOP:
      return "its symbolic links lead in a circle";
    case ENAMETOOLONG:
      return "choose a shorter name";
    case EMFILE:
    case ENFILE:
      return "too many files are open (see ulimit -n)";
    case ENOMEM:
      return "close other programs, or use a smaller file";
    default:
      return nullptr;
  }
}

}  // namespace

Error cannot(std::string_view action, const std::filesystem::path& path, int errnoValue) {
  // generic_category().message() is strerror without its shared buffer.
  std::string message = path.string() + ": cannot " + std::string(action) + ": " +
                        std::generic_category().message(errnoValue);
  if (const char* const hint = remedy(errnoValue)) message += std::string("; ") + hint;
  return report::badInput(std::move(message));
}

}  // namespace lambent::file
