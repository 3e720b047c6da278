#include "apps/lambent/piped_files.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <nlohmann/json.hpp>
#include <vector>

#include "apps/lambent/standard_streams.h"
#include "lambent/file/atomic_file.h"

namespace lambent::tool {

namespace {

namespace fs = std::filesystem;

/// {"asset": …} is a glTF, every other JSON for those who read lights to judge.
std::string extensionOfJson(std::string_view text) {
  bool gltf = false;
  const auto top = [&](int depth, nlohmann::json::parse_event_t event, nlohmann::json& value) {
    if (event == nlohmann::json::parse_event_t::key && depth == 1) gltf |= value == "asset";
    return depth < 2;  // what lies deeper is not kept
  };
  const bool whole = !nlohmann::json::parse(text.begin(), text.end(), top, false).is_discarded();
  return whole && gltf ? ".gltf" : ".json";
}

/// Whether a text begins as an OBJ does: remarks, then one of its words.
bool isObj(std::string_view text) {
  while (!text.empty()) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    std::string_view line = text.substr(0, end);
    text.remove_prefix(std::min(end + 1, text.size()));
    const std::size_t begin = line.find_first_not_of(" \t\r");
    if (begin == line.npos || line[begin] == '#') continue;
    const std::string_view word =
        line.substr(begin, std::min(line.find_first_of(" \t\r", begin), line.size()) - begin);
    for (const std::string_view known :
         {"v", "vn", "vt", "f", "o", "g", "s", "l", "mtllib", "usemtl"})
      if (word == known) return true;
    return false;
  }
  return false;
}

/// The extension that such bytes have in a file's name; empty: of no kind that is read. Of JSON all
/// of them are needed, else the beginning.
std::string extensionOfBytes(std::string_view bytes) {
  constexpr std::pair<std::string_view, std::string_view> kBeginnings[] = {
      {"glTF", ".glb"},         {"ply\n", ".ply"},        {"ply\r", ".ply"},
      {"v/1\x01", ".exr"},      {"#?RADIANCE", ".hdr"},   {"#?RGBE", ".hdr"},
      {"\x89PNG\r\n", ".png"},  {"\xff\xd8\xff", ".jpg"}, {"LRTT", ".rtt"},
      {"x,y,z,nx,ny,", ".csv"},
  };
  for (const auto& [beginning, extension] : kBeginnings)
    if (bytes.starts_with(beginning)) return std::string(extension);
  if (bytes.starts_with("RIFF") && bytes.substr(0, 12).ends_with("WEBP")) return ".webp";
  const std::size_t first = bytes.find_first_not_of(" \t\r\n");
  if (first != bytes.npos && bytes[first] == '{') return extensionOfJson(bytes);
  return isObj(bytes) ? ".obj" : "";
}

Error noRoom(const fs::path& path) {
  return report::badInput(
      fmt::format("standard input cannot be kept in {}: {}. TMPDIR names another folder for it",
                  path.parent_path().parent_path().string(), std::strerror(errno)));
}

/// Enough of a file to tell its kind by: 64 KiB, of JSON all of it.
Status readBeginning(const fs::path& path, std::string& text) {
  std::FILE* const file = std::fopen(path.c_str(), "rbe");
  text.resize(64 << 10);
  text.resize(file ? std::fread(text.data(), 1, text.size(), file) : 0);
  if (file) std::fclose(file);
  const std::size_t first = text.find_first_not_of(" \t\r\n");
  if (first == text.npos || text[first] != '{') return Status::ok();
  const auto bytes = file::readWhole(path);
  if (!bytes) return bytes.error();
  text.assign(reinterpret_cast<const char*>(bytes->data()), bytes->size());
  return Status::ok();
}

/// Copies until the end.
Status copyInput(int to, const fs::path& path) {
  std::vector<char> block(1 << 20);
  for (;;) {
    const ssize_t got = read(STDIN_FILENO, block.data(), block.size());
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) return report::badInput(fmt::format("standard input: {}", std::strerror(errno)));
    if (got == 0) return Status::ok();
    for (ssize_t at = 0; at < got;) {
      const ssize_t put = write(to, block.data() + at, std::size_t(got - at));
      if (put < 0 && errno == EINTR) continue;
      if (put < 0) return noRoom(path);
      at += put;
    }
  }
}

bool isForPeople(std::string_view extension) {
  return extension == ".json" || extension == ".csv";
}

void replaceAll(std::string& text, const std::string& from, std::string_view to) {
  if (from.empty()) return;
  for (std::size_t at = 0; (at = text.find(from, at)) != text.npos; at += to.size())
    text.replace(at, from.size(), to);
}

}  // namespace

Status PipedFiles::makeFolder() {
  if (folder_) return Status::ok();
  auto made = file::TemporaryFolder::create();
  if (!made) return report::badInput("'-': " + made.error().message);
  folder_.emplace(std::move(*made));
  return Status::ok();
}

Result<fs::path> PipedFiles::input(std::string_view name) {
  if (!input_.empty())
    return report::badUsage(fmt::format("{}: standard input can be read but once", name));
  if (isatty(STDIN_FILENO))
    return report::badUsage(fmt::format(
        "{}: standard input is a terminal: have a file or a pipe there, as in '… < FILE'", name));
  if (Status made = makeFolder(); !made) return made.error();
  const fs::path raw = folder_->place("standard-input");
  const int descriptor = open(raw.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0600);
  if (descriptor < 0) return noRoom(raw);
  Status copied = copyInput(descriptor, raw);
  close(descriptor);
  if (!copied) return copied.error();

  std::string beginning;
  if (Status s = readBeginning(raw, beginning); !s) return s.error();
  if (beginning.empty()) return report::badInput("standard input is empty");
  const std::string extension = extensionOfBytes(beginning);
  if (extension.empty())
    return report::badInput(
        "standard input is of no kind that is read here: .glb .gltf .obj .ply .exr .hdr .png .jpg "
        ".webp .json .csv .rtt, told by its first bytes");
  input_ = folder_->place("standard-input" + extension);
  if (std::rename(raw.c_str(), input_.c_str()) != 0) return noRoom(raw);
  return input_;
}

Result<fs::path> PipedFiles::output(std::string_view name, std::string_view extension) {
  if (hasOutput())
    return report::badUsage(fmt::format("{}: standard output can be written but once", name));
  if (isatty(STDOUT_FILENO) && !isForPeople(extension))
    return report::badUsage(
        fmt::format("{}: standard output is a terminal, and a {} is not for people to read: write "
                    "it to a file or a pipe, as in '{} - > FILE{}'",
                    name, extension, name, extension));
  if (Status made = makeFolder(); !made) return made.error();
  output_ = folder_->place(fmt::format("standard-output{}", extension));
  return output_;
}

Status PipedFiles::deliver() {
  const int from = open(output_.c_str(), O_RDONLY | O_CLOEXEC);
  if (from < 0)
    return report::failed(fmt::format("what was made is gone: {}", std::strerror(errno)));
  std::vector<char> block(1 << 20);
  for (;;) {
    const ssize_t got = read(from, block.data(), block.size());
    if (got < 0 && errno == EINTR) continue;
    Status status = got < 0 ? Status(report::failed(std::strerror(errno))) : Status::ok();
    if (got > 0) status = print(std::string_view(block.data(), std::size_t(got)));
    if (got > 0 && status) continue;
    close(from);
    return status;
  }
}

std::string PipedFiles::inWords(std::string text) const {
  replaceAll(text, input_.string(), "standard input");
  replaceAll(text, output_.string(), "standard output");
  if (folder_) replaceAll(text, folder_->path().string(), "the folder of standard input");
  return text;
}

std::string PipedFiles::asArgument(const std::string& text) const {
  const bool one = !text.empty() && (text == input_.string() || text == output_.string());
  return one ? "-" : inWords(text);
}

}  // namespace lambent::tool
