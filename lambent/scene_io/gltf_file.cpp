// The container, the buffers and the accessors of glTF 2.0 (Khronos Group, glTF 2.0 specification,
// §3.6 and §4.4). Every size is checked before it is believed.
#include <algorithm>
#include <array>
#include <cstring>
#include <map>

#include "lambent/file/json.h"
#include "lambent/scene_io/gltf_component.h"
#include "lambent/scene_io/gltf_json.h"
#include "lambent/scene_io/gltf_read.h"

namespace lambent::scene_io {
namespace {

using nlohmann::json;
using Bytes = std::span<const std::byte>;

/// An accessor without a buffer view is all zeros and no bytes of the file bound its size.
constexpr std::int64_t kMaxImplicitCount = std::int64_t(1) << 22;

std::uint32_t littleEndian32(Bytes bytes, std::size_t offset) {
  std::uint32_t value = 0;
  for (int i = 3; i >= 0; --i) value = value << 8 | std::uint32_t(bytes[offset + i]);
  return value;
}

}  // namespace

std::size_t AccessorView::elementSize() const {
  return componentSize(component) * std::size_t(componentCount);
}

struct GltfFile::Impl {
  Impl(const std::filesystem::path& where, const LoadOptions& options)
      : path(where), files(where, options) {}

  std::filesystem::path path;
  LinkedFiles files;
  nlohmann::json document;
  std::vector<std::byte> file;                           ///< the .glb, which BIN points into
  std::map<std::string, std::vector<std::byte>> linked;  ///< by place, or data URI
  std::vector<Bytes> buffers;

  Error bad(const std::string& message) const {
    return report::badInput(path.string() + ": " + message);
  }
  Result<Bytes> splitGlb(Bytes& binary) const;
  Status readBuffers(std::optional<Bytes> binary);
  Result<Bytes> view(std::int64_t index) const;
  /// Fills `view` with what an accessor-like object says; `offsetOwner` holds byteOffset.
  Status locate(const std::string& name, std::int64_t bufferView, std::int64_t offset,
                AccessorView& view) const;
  Result<AccessorView> describe(std::int64_t index, const nlohmann::json*& object) const;
};

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
    } else if (find(find(buffer, "extensions"), "EXT_meshopt_compression") == nullptr) {
      return bad(name + " has neither a uri nor a BIN chunk; export the file again");
    }
    if (std::uint64_t(*length) > bytes.size()) {
      return bad(name + " should have " + std::to_string(*length) + " bytes but has " +
                 std::to_string(bytes.size()) + ": the file is truncated; export it again");
    }
    buffers.push_back(bytes.first(std::size_t(*length)));
  }
  return Status::ok();
}

Result<Bytes> GltfFile::Impl::view(std::int64_t index) const {
  const std::string name = "bufferView " + std::to_string(index);
  const nlohmann::json* object = element(document, "bufferViews", index);
  if (object == nullptr) return bad(name + " does not exist");
  const std::int64_t buffer = integer(object, "buffer").value_or(-1);
  const std::int64_t offset = integer(object, "byteOffset").value_or(0);
  const std::int64_t length = integer(object, "byteLength").value_or(-1);
  if (buffer < 0 || std::size_t(buffer) >= buffers.size()) {
    return bad(name + " is of a buffer that does not exist");
  }
  const Bytes bytes = buffers[std::size_t(buffer)];
  if (offset < 0 || length < 0 || std::uint64_t(offset) + std::uint64_t(length) > bytes.size()) {
    return bad(name + " runs beyond the end of buffer " + std::to_string(buffer) + " (" +
               std::to_string(bytes.size()) + " bytes); export the file again");
  }
  return bytes.subspan(std::size_t(offset), std::size_t(length));
}

Status GltfFile::Impl::locate(const std::string& name, std::int64_t bufferView, std::int64_t offset,
                              AccessorView& accessor) const {
  const Result<Bytes> whole = view(bufferView);
  if (!whole) return whole.error();
  const std::size_t size = accessor.elementSize();
  const std::int64_t stride =
      integer(element(document, "bufferViews", bufferView), "byteStride").value_or(size);
  if (stride < std::int64_t(size) || stride > 65536) {
    return bad(name + " has a byteStride that is too small or too large for its elements");
  }
  accessor.stride = std::size_t(stride);
  const auto available = std::int64_t(whole->size());
  if (accessor.count == 0) return Status::ok();
  // (count − 1)·stride + size ≤ available − offset, written so that nothing can overflow.
  const std::int64_t room = available - offset - std::int64_t(size);
  if (offset < 0 || room < 0 || std::int64_t(accessor.count) - 1 > room / stride) {
    return bad(name + " (" + std::to_string(accessor.count) + " elements) runs beyond the end of " +
               "bufferView " + std::to_string(bufferView) + " (" + std::to_string(available) +
               " bytes); export the file again");
  }
  accessor.bytes =
      whole->subspan(std::size_t(offset), (accessor.count - 1) * accessor.stride + size);
  return Status::ok();
}

/// Everything of an accessor but its bytes.
Result<AccessorView> GltfFile::Impl::describe(std::int64_t index,
                                              const nlohmann::json*& object) const {
  const std::string name = "accessor " + std::to_string(index);
  object = element(document, "accessors", index);
  if (object == nullptr) return bad(name + " does not exist");
  AccessorView accessor;
  const auto component = componentOf(integer(object, "componentType"));
  if (!component) return bad(name + " has an unknown componentType");
  accessor.component = *component;
  accessor.componentCount = componentCountOf(text(object, "type"));
  if (accessor.componentCount == 0) return bad(name + " has an unknown type");
  const std::int64_t count = integer(object, "count").value_or(-1);
  if (count < 0) return bad(name + " has no valid count");
  accessor.count = std::size_t(count);
  accessor.normalized = flag(object, "normalized");
  accessor.stride = accessor.elementSize();
  return accessor;
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
  } else if (path.extension() == ".glb") {
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
  if (!version.starts_with("2.")) {
    return impl->bad("is glTF version \"" + version.substr(0, 20) +
                     "\"; Lambent reads version 2: export it again as glTF 2.0");
  }
  if (const Status status = impl->readBuffers(binary); !status) return status.error();
  return GltfFile(std::move(impl));
}

Result<std::span<const std::byte>> GltfFile::bufferViewBytes(std::int64_t bufferView) const {
  return impl_->view(bufferView);
}

Result<AccessorView> GltfFile::accessorView(std::int64_t index) const {
  const nlohmann::json* object = nullptr;
  Result<AccessorView> accessor = impl_->describe(index, object);
  if (!accessor) return accessor;
  const std::string name = "accessor " + std::to_string(index);
  const auto bufferView = integer(object, "bufferView");
  if (find(object, "sparse") != nullptr || !bufferView) {
    return impl_->bad(name + " is sparse or without bytes, which is not supported in its place");
  }
  const Status status =
      impl_->locate(name, *bufferView, integer(object, "byteOffset").value_or(0), *accessor);
  if (!status) return status.error();
  return accessor;
}

Result<std::span<const std::byte>> GltfFile::accessorBytes(std::int64_t index) const {
  const Result<AccessorView> view = accessorView(index);
  if (!view) return view.error();
  if (!view->packed()) {
    return impl_->bad("accessor " + std::to_string(index) + " should be tightly packed");
  }
  return view->bytes;
}

Result<std::vector<float>> GltfFile::accessorFloats(std::int64_t index, int componentCount) const {
  const nlohmann::json* object = nullptr;
  Result<AccessorView> accessor = impl_->describe(index, object);
  if (!accessor) return accessor.error();
  const std::string name = "accessor " + std::to_string(index);
  if (accessor->componentCount != componentCount) {
    return impl_->bad(name + " has " + std::to_string(accessor->componentCount) +
                      " components where " + std::to_string(componentCount) + " are needed");
  }
  const auto bufferView = integer(object, "bufferView");
  if (bufferView) {
    const Status status =
        impl_->locate(name, *bufferView, integer(object, "byteOffset").value_or(0), *accessor);
    if (!status) return status.error();
  } else if (accessor->count > std::size_t(kMaxImplicitCount)) {
    return impl_->bad(name + " has no bytes and an absurd count");
  }
  const auto width = std::size_t(componentCount);
  const std::uint64_t taken = std::uint64_t(accessor->count) * width * sizeof(float);
  if (Status fits = impl_->files.budget().hold(taken, impl_->path.string() + ": " + name); !fits) {
    return fits.error();
  }
  impl_->files.budget().release(taken);  // the caller keeps what it makes of them
  const std::size_t step = componentSize(accessor->component);
  std::vector<float> values(accessor->count * width, 0.0f);
  const auto copyElement = [&](const std::byte* from, float* to) {
    for (std::size_t c = 0; c < width; ++c) {
      to[c] = toFloat(from + c * step, accessor->component, accessor->normalized);
    }
  };
  if (bufferView && accessor->component == Component::Float && accessor->packed()) {
    if (!values.empty()) {
      std::memcpy(values.data(), accessor->bytes.data(), 4 * values.size());
    }
  } else if (bufferView) {
    for (std::size_t i = 0; i < accessor->count; ++i) {
      copyElement(accessor->bytes.data() + i * accessor->stride, values.data() + i * width);
    }
  }

  const nlohmann::json* sparse = find(object, "sparse");
  if (sparse == nullptr) return values;
  const nlohmann::json *where = find(sparse, "indices"), *what = find(sparse, "values");
  AccessorView places, news = *accessor;
  const std::int64_t changed = integer(sparse, "count").value_or(-1);
  const auto component = componentOf(integer(where, "componentType"));
  if (changed < 0 || !component || *component == Component::Float) {
    return impl_->bad(name + " is sparse in a way that is not valid");
  }
  places.component = *component;
  places.count = news.count = std::size_t(changed);
  for (const auto& [source, target] : {std::pair(where, &places), std::pair(what, &news)}) {
    const Status status =
        impl_->locate(name + " (sparse)", integer(source, "bufferView").value_or(-1),
                      integer(source, "byteOffset").value_or(0), *target);
    if (!status) return status.error();
  }
  for (std::size_t i = 0; i < places.count; ++i) {
    const std::byte* p = places.bytes.data() + i * places.stride;
    const std::size_t place =
        places.component == Component::UnsignedInt     ? loadComponent<std::uint32_t>(p)
        : places.component == Component::UnsignedShort ? loadComponent<std::uint16_t>(p)
                                                       : loadComponent<std::uint8_t>(p);
    if (place >= accessor->count) {
      return impl_->bad(name + " replaces element " + std::to_string(place) + " of " +
                        std::to_string(accessor->count));
    }
    copyElement(news.bytes.data() + i * news.stride, values.data() + place * width);
  }
  return values;
}

}  // namespace lambent::scene_io
