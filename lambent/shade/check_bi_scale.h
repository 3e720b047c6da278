// Whether meso-structure fits its meshes, and what is asked of it is there.
#pragma once

#include <string>

#include "lambent/asset/asset.h"
#include "lambent/report/result.h"
#include "lambent/shade/bi_scale_options.h"

namespace lambent::shade {

/// The first fault of any mesh with meso-structure: BadInput where the asset does not fit together
/// (the message names the mesh, the member and the receiver), BadUsage where `options` ask for
/// macro transport that a mesh does not hold (and how to bake it). exitRadiance wants it passed;
/// pictures ask themselves.
Status checkBiScale(const asset::Asset& asset, const BiScaleOptions& options);

/// Numbers that should be `expected` many. `what` as in "mesh 0 'x': its transfer matrices".
Status checkNumbers(const std::string& what, const encode::Numbers& numbers, std::size_t expected);

}  // namespace lambent::shade
