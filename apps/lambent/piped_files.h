// "-" on the command line. Readers and writers seek in files and go by their names, so that what
// comes from standard input is first put into a file of a folder of its own, and what is to go to
// standard output is first written to one.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include "lambent/file/temporary_folder.h"
#include "lambent/report/result.h"

namespace lambent::tool {

class PipedFiles {
 public:
  PipedFiles() = default;
  PipedFiles(const PipedFiles&) = delete;
  PipedFiles& operator=(const PipedFiles&) = delete;

  /// All of standard input, as a file whose extension is told by its bytes. BadUsage: asked for
  /// twice (`name`: by what), or it is a terminal. BadInput: empty, of no kind that is known, or
  /// no room for it.
  Result<std::filesystem::path> input(std::string_view name);
  /// A file to be written for deliver(), with that extension. BadUsage: asked for twice, or
  /// standard output is a terminal and the bytes are not for people.
  Result<std::filesystem::path> output(std::string_view name, std::string_view extension);
  bool hasOutput() const { return !output_.empty(); }
  /// Its bytes to standard output. As print().
  Status deliver();

  /// A text in which the files have these names: "standard input", "standard output".
  std::string inWords(std::string text) const;
  /// "-" for the two files, else the text in words.
  std::string asArgument(const std::string& text) const;

 private:
  Status makeFolder();

  std::optional<file::TemporaryFolder> folder_;
  std::filesystem::path input_, output_;
};

}  // namespace lambent::tool
