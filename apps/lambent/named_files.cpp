#include "apps/lambent/named_files.h"

#include <fmt/format.h>

#include <algorithm>
#include <system_error>

#include "apps/lambent/arguments.h"
#include "lambent/asset/read.h"
#include "lambent/file/atomic_file.h"
#include "lambent/sources/source.h"
#include "lambent/view/view_state.h"

namespace lambent::tool {

namespace {

namespace fs = std::filesystem;

/// Where a file is or would appear, by its one name from the root on: a link that leads to no file
/// yet leads to where it will be.
fs::path placeOf(const fs::path& path) {
  std::error_code error;
  // weakly_canonical() leaves a relative name of what is not there as it is.
  fs::path at = fs::absolute(path, error);
  for (int depth = 0; depth < 40 && fs::is_symlink(fs::symlink_status(at, error)); ++depth) {
    const fs::path next = fs::read_symlink(at, error);
    if (error) break;
    at = next.is_absolute() ? next : at.parent_path() / next;
  }
  const fs::path place = fs::weakly_canonical(at, error);
  return error ? at.lexically_normal() : place;
}

/// Links of both kinds are followed; of files that are not there yet the places are compared.
bool isSame(const fs::path& a, const fs::path& b) {
  std::error_code ignored;
  return fs::equivalent(a, b, ignored) || placeOf(a) == placeOf(b);
}

}  // namespace

void NamedFiles::reads(std::string name, const fs::path& path) {
  if (!path.empty()) inputs_.push_back({std::move(name), path});
}

void NamedFiles::readsFilesOf(const std::string& name, std::span<const fs::path> paths) {
  for (const fs::path& path : paths) reads("a file of " + name, path);
}

void NamedFiles::readsLinksOf(const std::string& name, const fs::path& asset) {
  if (const auto linked = asset::linkedFiles(asset)) readsFilesOf(name, *linked);
}

void NamedFiles::readsAsset(const std::string& name, const fs::path& path) {
  if (path.empty()) return;
  reads(name, path);
  readsLinksOf(name, path);
}

void NamedFiles::readsState(const std::string& name, const fs::path& path) {
  if (path.empty()) return;
  reads(name, path);
  if (const auto state = view::readViewState(path))
    readsLight("the light of " + name, state->environment);
}

void NamedFiles::readsLight(const std::string& name, std::string_view source) {
  for (const std::string_view term : sources::sourceTerms(source))
    for (const fs::path& path : sources::filesOf(term)) reads(name, path);
}

void NamedFiles::writes(std::string option, const fs::path& path,
                        std::vector<std::string> extensions) {
  if (!path.empty()) outputs_.push_back({std::move(option), path, std::move(extensions), false});
}

void NamedFiles::writesLater(std::string name, const fs::path& path) {
  outputs_.push_back({std::move(name), path, {}, true});
}

Status NamedFiles::check() const {
  for (const Input& input : inputs_)
    if (input.path == "-")
      return badUsage(
          fmt::format("{}: standard input is not read here: name a file (./- is one of that name)",
                      input.name));
  for (std::size_t i = 0; i < outputs_.size(); ++i) {
    const auto& [option, path, extensions, later] = outputs_[i];
    if (path == "-")
      return badUsage(fmt::format(
          "{}: standard output is not written here: name a file (./- is one of that name)",
          option));
    if (!later &&
        std::find(extensions.begin(), extensions.end(), extensionOf(path)) == extensions.end())
      return badUsage(fmt::format("{}: the output {} must end in {}", option, path.string(),
                                  fmt::join(extensions, " or ")));
    for (const Input& input : inputs_)
      if (isSame(path, input.path))
        return badUsage(
            fmt::format("{}: the output {} would replace the input {} ({}): give it another name",
                        option, path.string(), input.path.string(), input.name));
    for (std::size_t j = 0; j < i && !later; ++j)  // a script may make a picture anew
      if (isSame(path, outputs_[j].path))
        return badUsage(
            fmt::format("{}: the output {} would replace the output {} ({}): give one another name",
                        option, path.string(), outputs_[j].path.string(), outputs_[j].option));
  }
  for (const Output& output : outputs_)
    if (!output.later)
      if (Status writable = written(file::checkWritable(output.path)); !writable) return writable;
  return Status::ok();
}

}  // namespace lambent::tool
