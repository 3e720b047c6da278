// The files that a command reads and those it writes: no output may replace an input, nor what an
// input names, nor another output.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "lambent/report/result.h"

namespace lambent::tool {

class NamedFiles {
 public:
  /// `name`: the option or the place of the command line that the file has, such as "--rtt". A path
  /// that is empty is none.
  void reads(std::string name, const std::filesystem::path& path);
  /// What a file names in turn: buffers, pictures, material libraries.
  void readsFilesOf(const std::string& name, std::span<const std::filesystem::path> paths);
  /// The same of a baked asset, before it is read: a look at its JSON. What cannot be looked at is
  /// its reader's to explain.
  void readsLinksOf(const std::string& name, const std::filesystem::path& asset);
  /// A baked asset and the files that it names.
  void readsAsset(const std::string& name, const std::filesystem::path& path);
  /// The state of a viewer and the files among the terms of its SOURCE, if it can be read.
  void readsState(const std::string& name, const std::filesystem::path& path);
  /// The files among the terms of a SOURCE.
  void readsLight(const std::string& name, std::string_view source);
  /// An output, with the extensions that it may have.
  void writes(std::string option, const std::filesystem::path& path,
              std::vector<std::string> extensions);

  /// What a script writes on its way: whether it can is only known then.
  void writesLater(std::string name, const std::filesystem::path& path);

  /// Whether every output can appear at its place, and replaces nothing of this command: BadUsage
  /// or BadInput. Asked before long work, and again when it is known what the inputs name.
  Status check() const;

 private:
  struct Input {
    std::string name;
    std::filesystem::path path;
  };
  struct Output {
    std::string option;
    std::filesystem::path path;
    std::vector<std::string> extensions;
    bool later = false;
  };
  std::vector<Input> inputs_;
  std::vector<Output> outputs_;
};

}  // namespace lambent::tool
