#include "lambent/scene_io/gltf_types.h"

#include <string>
#include <string_view>

#include "lambent/scene_io/gltf_json.h"

namespace lambent::scene_io {
namespace {

using nlohmann::json;

enum class Type { Array, Object, Number, Text };

struct Member {
  std::string_view list;  ///< of the document; its entries are objects
  std::string_view key;
  Type type;
};

// What a scene is lost by. Numbers and flags that are read alone have their defaults.
constexpr Member kMembers[] = {
    {"scenes", "nodes", Type::Array},
    {"nodes", "children", Type::Array},
    {"nodes", "mesh", Type::Number},
    {"nodes", "extensions", Type::Object},
    {"meshes", "primitives", Type::Array},
    {"materials", "pbrMetallicRoughness", Type::Object},
    {"materials", "emissiveFactor", Type::Array},
    {"materials", "emissiveTexture", Type::Object},
    {"materials", "normalTexture", Type::Object},
    {"materials", "alphaMode", Type::Text},
    {"materials", "extensions", Type::Object},
    {"textures", "source", Type::Number},
    {"textures", "sampler", Type::Number},
    {"textures", "extensions", Type::Object},
    {"images", "uri", Type::Text},
    {"images", "bufferView", Type::Number},
    {"skins", "joints", Type::Array},
};

constexpr Member kOfPrimitives[] = {
    {"", "attributes", Type::Object}, {"", "indices", Type::Number},
    {"", "material", Type::Number},   {"", "mode", Type::Number},
    {"", "targets", Type::Array},     {"", "extensions", Type::Object},
};

constexpr std::string_view kLists[] = {"scenes",   "nodes",   "meshes",      "materials",
                                       "textures", "images",  "samplers",    "accessors",
                                       "buffers",  "cameras", "bufferViews", "skins"};

bool isOf(const json& value, Type type) {
  switch (type) {
    case Type::Array:
      return value.is_array();
    case Type::Object:
      return value.is_object();
    case Type::Number:
      return value.is_number();
    default:
      return value.is_string();
  }
}

class TypeCheck {
 public:
  explicit TypeCheck(const json& document) : document_(document) {}

  void check(const json* object, std::string_view key, Type type, const std::string& place) {
    const json* value = find(object, key);
    if (value != nullptr && !isOf(*value, type)) {
      found(place + "." + std::string(key) + " is " + value->type_name());
    }
  }
  void checkAll() {
    for (const std::string_view list : kLists) {
      const json* entries = find(document_, list);
      if (entries != nullptr && !entries->is_array()) {
        found(std::string(list) + " is " + entries->type_name());
      }
    }
    for (const Member& member : kMembers) {
      const json* entries = find(document_, member.list);
      for (std::size_t i = 0; i < arraySize(entries); ++i) {
        check(&(*entries)[i], member.key, member.type, placeOf(member.list, i));
      }
    }
    const json* meshes = find(document_, "meshes");
    for (std::size_t m = 0; m < arraySize(meshes); ++m) {
      const json* primitives = find((*meshes)[m], "primitives");
      for (std::size_t p = 0; p < arraySize(primitives); ++p) {
        for (const Member& member : kOfPrimitives) {
          check(&(*primitives)[p], member.key, member.type,
                placeOf("meshes", m) + "." + placeOf("primitives", p));
        }
      }
    }
  }

  std::uint64_t count = 0;
  std::string first;

 private:
  static std::string placeOf(std::string_view list, std::size_t index) {
    return std::string(list) + "[" + std::to_string(index) + "]";
  }
  void found(std::string what) {
    if (count++ == 0) first = std::move(what);
  }

  const json& document_;
};

}  // namespace

void noteWrongTypes(const json& document, Diagnosis& diagnosis) {
  TypeCheck check(document);
  check.checkAll();
  if (check.count == 0) return;
  diagnosis.lose(Severity::Warning, "wrong-types", check.count,
                 "members are of another type than glTF gives them and were taken as if they were "
                 "not there; what they stand for is lost: export the file again",
                 check.first);
}

}  // namespace lambent::scene_io
