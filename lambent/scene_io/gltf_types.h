// Members of a glTF document that are of another JSON type than the specification gives them.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "lambent/scene_io/diagnosis.h"

namespace lambent::scene_io {

/// Readers take such a member as if it were not there: one finding counts them and names the first.
void noteWrongTypes(const nlohmann::json& document, Diagnosis& diagnosis);

}  // namespace lambent::scene_io
