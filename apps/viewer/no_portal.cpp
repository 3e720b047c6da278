// Instead of portal.cpp where libdbus was not there to build with.
#include "apps/viewer/portal.h"

namespace lambent::viewer {

FileAnswer askPortal(const FileQuestion&, const std::string&, std::stop_token) {
  return {FileAnswer::How::NoDialog, {}, "this Lambent was built without libdbus"};
}

}  // namespace lambent::viewer
