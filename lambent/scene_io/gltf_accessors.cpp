// The buffer views and accessors of glTF 2.0 (Khronos Group, glTF 2.0 specification, §3.6.2). Every
// count is checked before it is believed.
#include <cstring>

#include "lambent/scene_io/gltf_component.h"
#include "lambent/scene_io/gltf_file_impl.h"
#include "lambent/scene_io/gltf_meshopt.h"

namespace lambent::scene_io {
namespace {

using Bytes = std::span<const std::byte>;

/// An accessor without a buffer view is all zeros and no bytes of the file bound its size.
constexpr std::int64_t kMaxImplicitCount = std::int64_t(1) << 22;

/// From one element to the next. 0 is not allowed, is met, and means what no byteStride means.
std::int64_t strideOf(const nlohmann::json& view, std::size_t elementSize) {
  const std::int64_t own = integer(view, "byteStride").value_or(0);
  if (own != 0) return own;
  const nlohmann::json* compression = meshoptCompressionOf(view);
  const bool attributes = text(compression, "mode") == "ATTRIBUTES";
  return attributes ? integer(compression, "byteStride").value_or(0) : std::int64_t(elementSize);
}

}  // namespace

std::size_t AccessorView::elementSize() const {
  return componentSize(component) * std::size_t(componentCount);
}

Result<Bytes> GltfFile::Impl::part(const nlohmann::json* object, const std::string& name) const {
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

Result<Bytes> GltfFile::Impl::view(std::int64_t index) {
  const std::string name = "bufferView " + std::to_string(index);
  const nlohmann::json* object = element(document, "bufferViews", index);
  if (object == nullptr) return bad(name + " does not exist");
  Result<Bytes> own = part(object, name);
  const nlohmann::json* compression = meshoptCompressionOf(*object);
  if (own || compression == nullptr) return own;
  if (const auto known = decompressed.find(index); known != decompressed.end()) {
    return Bytes(known->second);
  }
  const Result<Bytes> packed = part(compression, name);
  if (!packed) return packed.error();
  Result<std::vector<std::byte>> bytes =
      decodeMeshopt(*compression, *packed, path.string() + ": " + name, files.budget());
  if (!bytes) return bytes.error();
  return Bytes(decompressed.emplace(index, std::move(*bytes)).first->second);
}

Status GltfFile::Impl::locate(const std::string& name, std::int64_t bufferView, std::int64_t offset,
                              AccessorView& accessor) {
  const Result<Bytes> whole = view(bufferView);
  if (!whole) return whole.error();
  const std::size_t size = accessor.elementSize();
  const std::int64_t stride = strideOf(*element(document, "bufferViews", bufferView), size);
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

template <class T>
Result<std::vector<T>> GltfFile::Impl::elements(std::int64_t index, int componentCount,
                                                Component own,
                                                T (*convert)(const std::byte*, Component, bool)) {
  const nlohmann::json* object = nullptr;
  Result<AccessorView> accessor = describe(index, object);
  if (!accessor) return accessor.error();
  const std::string name = "accessor " + std::to_string(index);
  if (accessor->componentCount != componentCount) {
    return bad(name + " has " + std::to_string(accessor->componentCount) + " components where " +
               std::to_string(componentCount) + " are needed");
  }
  const auto bufferView = integer(object, "bufferView");
  if (bufferView) {
    const Status status =
        locate(name, *bufferView, integer(object, "byteOffset").value_or(0), *accessor);
    if (!status) return status.error();
  } else if (accessor->count > std::size_t(kMaxImplicitCount)) {
    return bad(name + " has no bytes and an absurd count");
  }
  const auto width = std::size_t(componentCount);
  const std::uint64_t taken = std::uint64_t(accessor->count) * width * sizeof(T);
  if (Status fits = files.budget().hold(taken, path.string() + ": " + name); !fits) {
    return fits.error();
  }
  files.budget().release(taken);  // the caller keeps what it makes of them
  const std::size_t step = componentSize(accessor->component);
  std::vector<T> values(accessor->count * width, T(0));
  const auto copyElement = [&](const std::byte* from, T* to) {
    for (std::size_t c = 0; c < width; ++c) {
      to[c] = convert(from + c * step, accessor->component, accessor->normalized);
    }
  };
  if (bufferView && accessor->component == own && accessor->packed()) {
    if (!values.empty()) {
      std::memcpy(values.data(), accessor->bytes.data(), sizeof(T) * values.size());
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
    return bad(name + " is sparse in a way that is not valid");
  }
  places.component = *component;
  places.count = news.count = std::size_t(changed);
  for (const auto& [source, target] : {std::pair(where, &places), std::pair(what, &news)}) {
    const Status status = locate(name + " (sparse)", integer(source, "bufferView").value_or(-1),
                                 integer(source, "byteOffset").value_or(0), *target);
    if (!status) return status.error();
  }
  for (std::size_t i = 0; i < places.count; ++i) {
    const std::size_t place =
        toInteger(places.bytes.data() + i * places.stride, places.component, false);
    if (place >= accessor->count) {
      return bad(name + " replaces element " + std::to_string(place) + " of " +
                 std::to_string(accessor->count));
    }
    copyElement(news.bytes.data() + i * news.stride, values.data() + place * width);
  }
  return values;
}

Result<std::vector<float>> GltfFile::accessorFloats(std::int64_t index, int componentCount) const {
  return impl_->elements<float>(index, componentCount, Component::Float, toFloat);
}

Result<std::vector<std::uint32_t>> GltfFile::accessorIntegers(std::int64_t index,
                                                              int componentCount) const {
  const nlohmann::json* object = nullptr;
  const Result<AccessorView> accessor = impl_->describe(index, object);
  if (!accessor) return accessor.error();
  if (accessor->component == Component::Float) {
    return impl_->bad("accessor " + std::to_string(index) + " holds no whole numbers");
  }
  return impl_->elements<std::uint32_t>(index, componentCount, Component::UnsignedInt, toInteger);
}

}  // namespace lambent::scene_io
