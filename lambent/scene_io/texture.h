// Encoded pictures → textures.
#pragma once

#include <span>
#include <string>

#include "lambent/file/budget.h"
#include "lambent/report/result.h"
#include "lambent/scene/scene.h"

namespace lambent::scene_io {

/// Whether `bytes` begin as a kind of picture that decodeTexture() reads: what is of another kind
/// may be left out of a scene with a Warning; what is damaged is an error.
bool isReadablePicture(std::span<const std::byte> bytes);

/// PNG, JPEG (both kept in `encoded` too, so that an asset can carry them) or WebP. `place` begins
/// the error's message. What the texture takes is held in `budget`.
Result<scene::Texture> decodeTexture(std::span<const std::byte> bytes, const std::string& place,
                                     file::Budget& budget);

/// A texture of one picture's colour (white without it) and another's alpha, of the larger size
/// each way: its alpha where it has any, its grey otherwise. Of the colour's name and wrapping.
Result<scene::Texture> withAlphaOf(const scene::Texture* color, const scene::Texture& alpha,
                                   const std::string& place, file::Budget& budget);

}  // namespace lambent::scene_io
