// The container and the buffers of glTF 2.0 (Khronos Group, glTF 2.0 specification, §3.6 and §4.4).
// Every size is checked before it is believed.
#include <algorithm>
#include <cctype>

#include "lambent/file/json.h"
#include "lambent/scene_io/gltf_file_impl.h"
#include "lambent/scene_io/gltf_meshopt.h"

namespace lambent::scene_io {
namespace {

using Bytes = std::span<const std::byte>;

std::uint32_t littleEndian32(Bytes bytes, std::size_t offset) {
  std::uint32_t value = 0;
  for (int i = 3; i >= 0; --i) value = value << 8 | std::uint32_t(bytes[offset + i]);
  return value;
}

/// A .gltf that was called .glb.
bool beginsAsJson(Bytes bytes) {
  std::size_t i = 0;
  if (bytes.size() > 3 && littleEndian32(bytes, 0) << 8 == 0xbfbbef00) i = 3;  // a byte order mark
  while (i < bytes.size() && std::isspace(std::to_integer<int>(bytes[i])) != 0) ++i;
  return i < bytes.size() && bytes[i] == std::byte('{');
}

/// By how many bytes a buffer may be shorter than it says: some writers round up in one place only.
constexpr std::uint64_t kPadding = 3;

}  // namespace

/// Returns the JSON chunk and sets `binary` to the BIN chunk (or leaves it empty).
Result<Bytes> GltfFile::Impl::splitGlb(Bytes& binary) const {
  const Bytes bytes = file;
  if (bytes.size() < 20) return bad("the file is truncated: a .glb has a header of 20 bytes");
  const std::uint32_t version = littleEndian32(bytes, 4);
  if (version != 2) {
    return bad("is glTF version " + std::to_string(version) +
               "; Lambent reads version 2: export it again as glTF 2.0");
  }
  const std::uint64_t length = littleEndian32(bytes, 8);
  if (length > bytes.size()) {
    return bad("the file is truncated: its header says " + std::to_string(length) +
               " bytes, it has " + std::to_string(bytes.size()) + "; copy or export it again");
  }
  const std::uint64_t jsonLength = littleEndian32(bytes, 12);
  if (littleEndian32(bytes, 16) != 0x4e4f534a || 20 + jsonLength > length) {
    return bad("the first chunk is not whole JSON; export the file again");
  }
  std::uint64_t offset = (20 + jsonLength + 3) / 4 * 4;
  while (offset + 8 <= length) {
    const std::uint64_t size = littleEndian32(bytes, offset);
    if (offset + 8 + size > length) {
      return bad("the chunk at byte " + std::to_string(offset) +
                 " runs beyond the end of the file; export the file again");
    }
    if (littleEndian32(bytes, offset + 4) == 0x004e4942) {
      binary = bytes.subspan(offset + 8, size);
      break;
    }
    offset = (offset + 8 + size + 3) / 4 * 4;  // chunks of kinds we do not know are skipped
  }
  return bytes.subspan(20, jsonLength);
}

Status GltfFile::Impl::readBuffers(std::optional<Bytes> binary) {
  const std::size_t count = arraySize(find(document, "buffers"));
  for (std::size_t i = 0; i < count; ++i) {
    const std::string name = "buffer " + std::to_string(i);
    const nlohmann::json* buffer = element(document, "buffers", std::int64_t(i));
    const auto length = integer(buffer, "byteLength");
    if (!length || *length < 0) return bad(name + " has no valid byteLength");
    Bytes bytes;
    if (const nlohmann::json* uri = find(buffer, "uri"); uri != nullptr && uri->is_string()) {
      const std::string text = uri->get<std::string>();
      const std::string place = isDataUri(text) ? text : files.placeOf(text).string();
      auto known = linked.find(place);
      if (known == linked.end()) {
        Result<std::vector<std::byte>> content = files.readUri(text, name);
        if (!content) return content.error();
        known = linked.emplace(place, std::move(*content)).first;
      }
      bytes = known->second;
    } else if (i == 0 && binary) {
      bytes = *binary;
    } else if (meshoptCompressionOf(*buffer) != nullptr) {
      buffers.push_back({});  // what would be in it is compressed, in another
      continue;
    } else {
      return bad(name + " has neither a uri nor a BIN chunk; export the file again");
    }
    if (std::uint64_t(*length) > bytes.size() + kPadding) {
      return bad(name + " should have " + std::to_string(*length) + " bytes but has " +
                 std::to_string(bytes.size()) + ": the file is truncated; export it again");
    }
    buffers.push_back(bytes.first(std::min(std::size_t(*length), bytes.size())));
  }
  return Status::ok();
}

GltfFile::GltfFile(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
GltfFile::GltfFile(GltfFile&&) noexcept = default;
GltfFile& GltfFile::operator=(GltfFile&&) noexcept = default;
GltfFile::~GltfFile() = default;

const std::filesystem::path& GltfFile::path() const {
  return impl_->path;
}
const nlohmann::json& GltfFile::json() const {
  return impl_->document;
}
LinkedFiles& GltfFile::linkedFiles() const {
  return impl_->files;
}
file::Budget& GltfFile::budget() const {
  return impl_->files.budget();
}

Result<GltfFile> GltfFile::open(const std::filesystem::path& path, const LoadOptions& options) {
  auto impl = std::make_unique<Impl>(path, options);
  Result<std::vector<std::byte>> bytes = impl->files.readScene();
  if (!bytes) return bytes.error();
  impl->file = std::move(*bytes);
  if (impl->file.empty()) return impl->bad("the file is empty");

  Bytes jsonBytes = impl->file;
  std::optional<Bytes> binary;
  if (impl->file.size() >= 4 && littleEndian32(impl->file, 0) == 0x46546c67) {
    Bytes chunk;
    const Result<Bytes> split = impl->splitGlb(chunk);
    if (!split) return split.error();
    jsonBytes = *split;
    binary = chunk;
  } else if (path.extension() == ".glb" && !beginsAsJson(impl->file)) {
    return impl->bad("is not a .glb: it does not begin with \"glTF\"; export it again");
  }
  const char* first = reinterpret_cast<const char*>(jsonBytes.data());
  Result<nlohmann::json> document = file::parseJson({first, jsonBytes.size()});
  if (!document) {
    return impl->bad("its JSON is damaged or the file is not glTF: " + document.error().message +
                     "; export it again");
  }
  impl->document = std::move(*document);
  if (!impl->document.is_object()) {
    return impl->bad("its JSON is damaged or the file is not glTF; export it again");
  }
  const std::string version = text(find(impl->document, "asset"), "version");
  if (version.empty()) {
    return impl->bad(
        "does not say which version of glTF it is, as files of version 1 may; Lambent "
        "reads version 2: export it again as glTF 2.0");
  }
  if (!version.starts_with("2.")) {
    return impl->bad("is glTF version \"" + version.substr(0, 20) +
                     "\"; Lambent reads version 2: export it again as glTF 2.0");
  }
  if (const Status status = impl->readBuffers(binary); !status) return status.error();
  return GltfFile(std::move(impl));
}

}  // namespace lambent::scene_io
