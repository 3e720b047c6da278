// Draco's own decoders, with a look at every count before memory is taken for it: a stream of some
// hundred bytes can say that it holds a thousand million equal triangles.
#include "lambent/scene_io/gltf_draco.h"

#include <algorithm>
#include <cstring>
#include <limits>
#include <optional>
#include <type_traits>

#include <draco/compression/config/compression_shared.h>
#include <draco/compression/mesh/mesh_edgebreaker_decoder.h>
#include <draco/compression/mesh/mesh_sequential_decoder.h>
#include <draco/core/varint_decoding.h>
#include <draco/mesh/mesh.h>

#include "lambent/scene_io/gltf_component.h"

namespace lambent::scene_io {
namespace {

/// What the decoders keep for a face and for a point while they work: corner tables, traversals; and
/// for a face once more for each attribute with seams of its own.
constexpr std::uint64_t kBytesPerFace = 200, kBytesPerPoint = 64, kBytesPerSeamFace = 48;

/// The account of one stream.
struct Account {
  file::Budget& budget;
  const std::string& place;
  std::uint64_t held = 0;
  std::optional<Error> refused;

  bool hold(std::uint64_t bytes) {
    if (Status fits = budget.hold(bytes, place); !fits) {
      refused = fits.error();
      return false;
    }
    held += bytes;
    return true;
  }
};

/// One of Draco's decoders, which asks first.
template <class Decoder>
class AskingDecoder : public Decoder {
 public:
  explicit AskingDecoder(Account& account) : account_(account) {}

 protected:
  bool DecodeConnectivity() override {
    draco::DecoderBuffer ahead = *this->buffer();
    return askForCounts(ahead) && Decoder::DecodeConnectivity();
  }
  bool DecodeAllAttributes() override {
    std::uint64_t bytes = 0;
    for (std::int32_t i = 0; i < this->point_cloud()->num_attributes(); ++i) {
      const draco::PointAttribute& attribute = *this->point_cloud()->attribute(i);
      // The values as they are, and as integers before that.
      const std::uint64_t component = 4 + std::uint64_t(DataTypeLength(attribute.data_type()));
      bytes += std::uint64_t(attribute.num_components()) * component + 4;
    }
    return account_.hold(bytes * this->point_cloud()->num_points()) &&
           Decoder::DecodeAllAttributes();
  }

 private:
  static constexpr bool kEdgebreaker = std::is_same_v<Decoder, draco::MeshEdgebreakerDecoder>;

  /// The counts of faces and points stand at the beginning of the connectivity.
  bool askForCounts(draco::DecoderBuffer& ahead) {
    std::uint64_t points = 0, faces = 0;
    if constexpr (kEdgebreaker) {
      std::uint8_t withSeams = 0;
      std::uint64_t added = 0;
      if (this->bitstream_version() < DRACO_BITSTREAM_VERSION(2, 2) && !count(ahead, added)) {
        return false;
      }
      if (!count(ahead, points) || !count(ahead, faces) || !ahead.Decode(&withSeams)) return false;
      return account_.hold((points + added) * kBytesPerPoint +
                           faces * (kBytesPerFace + withSeams * kBytesPerSeamFace));
    } else {
      return count(ahead, faces) && count(ahead, points) &&
             account_.hold(points * kBytesPerPoint + faces * kBytesPerFace);
    }
  }
  bool count(draco::DecoderBuffer& ahead, std::uint64_t& value) {
    std::uint32_t read = 0;
    const bool fixed =
        this->bitstream_version() < DRACO_BITSTREAM_VERSION(2, (kEdgebreaker ? 0 : 2));
    if (!(fixed ? ahead.Decode(&read) : draco::DecodeVarint(&read, &ahead))) return false;
    value = read;
    return true;
  }

  Account& account_;
};

std::optional<Component> componentOf(draco::DataType type) {
  switch (type) {
    case draco::DT_INT8:
      return Component::Byte;
    case draco::DT_UINT8:
      return Component::UnsignedByte;
    case draco::DT_INT16:
      return Component::Short;
    case draco::DT_UINT16:
      return Component::UnsignedShort;
    case draco::DT_UINT32:
      return Component::UnsignedInt;
    case draco::DT_FLOAT32:
      return Component::Float;
    default:
      return {};
  }
}

constexpr const char* kPlainMesh =
    "export it without Draco compression, or decompress it: npx @gltf-transform/cli copy IN.glb "
    "OUT.glb";

}  // namespace

struct DracoPrimitive::Impl {
  Impl(const std::string& where, file::Budget& account) : place(where), budget(account) {}
  ~Impl() { budget.release(held); }

  std::string place;
  file::Budget& budget;
  std::uint64_t held = 0;
  draco::Mesh mesh;
};

DracoPrimitive::DracoPrimitive(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
DracoPrimitive::DracoPrimitive(DracoPrimitive&&) noexcept = default;
DracoPrimitive& DracoPrimitive::operator=(DracoPrimitive&&) noexcept = default;
DracoPrimitive::~DracoPrimitive() = default;

Result<DracoPrimitive> DracoPrimitive::decode(std::span<const std::byte> bytes,
                                              const std::string& place, file::Budget& budget) {
  auto impl = std::make_unique<Impl>(place, budget);
  const auto damaged = [&](const std::string& why) {
    return report::badInput(place +
                            ": its Draco compression is damaged, or of a kind that is not "
                            "read (" +
                            why + "); " + kPlainMesh);
  };
  draco::DecoderBuffer buffer;
  buffer.Init(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  // "DRACO", the version, the kind of geometry (1: a mesh), the method.
  if (bytes.size() < 11 || std::memcmp(bytes.data(), "DRACO", 5) != 0) {
    return damaged("it does not begin with \"DRACO\"");
  }
  if (bytes[7] != std::byte(draco::TRIANGULAR_MESH)) return damaged("it holds no triangles");
  Account account{budget, place, 0, {}};
  const draco::DecoderOptions options;
  draco::Status status;
  if (bytes[8] == std::byte(draco::MESH_EDGEBREAKER_ENCODING)) {
    status =
        AskingDecoder<draco::MeshEdgebreakerDecoder>(account).Decode(options, &buffer, &impl->mesh);
  } else {
    status =
        AskingDecoder<draco::MeshSequentialDecoder>(account).Decode(options, &buffer, &impl->mesh);
  }
  impl->held = account.held;
  if (account.refused) return *account.refused;
  if (!status.ok()) return damaged(status.error_msg_string());
  for (draco::FaceIndex f(0); f < impl->mesh.num_faces(); ++f) {
    for (const draco::PointIndex& corner : impl->mesh.face(f)) {
      if (corner.value() >= impl->mesh.num_points())
        return damaged("a triangle has no such vertex");
    }
  }
  return DracoPrimitive(std::move(impl));
}

std::size_t DracoPrimitive::vertices() const {
  return impl_->mesh.num_points();
}

std::vector<scene::Triangle> DracoPrimitive::triangles() const {
  std::vector<scene::Triangle> triangles;
  triangles.reserve(impl_->mesh.num_faces());
  for (draco::FaceIndex f(0); f < impl_->mesh.num_faces(); ++f) {
    const draco::Mesh::Face& face = impl_->mesh.face(f);
    triangles.push_back({face[0].value(), face[1].value(), face[2].value()});
  }
  return triangles;
}

Result<std::vector<float>> DracoPrimitive::floats(std::int64_t id, int width,
                                                  bool normalized) const {
  const bool possible = id >= 0 && id <= std::numeric_limits<std::uint32_t>::max();
  const draco::PointAttribute* attribute =
      possible ? impl_->mesh.GetAttributeByUniqueId(std::uint32_t(id)) : nullptr;
  if (attribute == nullptr) {
    return report::badInput(impl_->place + ": Draco holds no attribute " + std::to_string(id) +
                            ", which the file names; " + kPlainMesh);
  }
  const auto component = componentOf(attribute->data_type());
  if (!component || attribute->num_components() < width) {
    return report::badInput(impl_->place + ": attribute " + std::to_string(id) +
                            " in Draco is of a type that does not fit; " + kPlainMesh);
  }
  const std::size_t step = componentSize(*component), count = vertices();
  std::vector<float> values(count * std::size_t(width));
  for (std::size_t i = 0; i < count; ++i) {
    const draco::AttributeValueIndex at =
        attribute->mapped_index(draco::PointIndex(std::uint32_t(i)));
    if (at.value() >= attribute->size()) {
      return report::badInput(impl_->place + ": its Draco compression is damaged; " + kPlainMesh);
    }
    const auto* from = reinterpret_cast<const std::byte*>(attribute->GetAddress(at));
    for (int c = 0; c < width; ++c) {
      values[i * std::size_t(width) + std::size_t(c)] =
          toFloat(from + std::size_t(c) * step, *component, normalized);
    }
  }
  return values;
}

}  // namespace lambent::scene_io
