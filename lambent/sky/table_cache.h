// Tables of skies and of the light in their air, which stay on disk between runs.
#pragma once

#include <filesystem>
#include <optional>
#include <span>

#include "lambent/sky/sky_table.h"

namespace lambent::sky {

/// Nothing if the folder is empty (""), or holds no table of this atmosphere and altitude that can
/// be trusted.
std::optional<SkyTable> readTable(const std::filesystem::path& folder, const Atmosphere& atmosphere,
                                  double altitude);
/// Makes the folder if it must. Ok if the folder is "".
Status keepTable(const std::filesystem::path& folder, const Atmosphere& atmosphere,
                 const SkyTable& table);

/// The same of what was solved for the wavelengths (nm) of an atmosphere.
std::optional<Scattering> readScattering(const std::filesystem::path& folder,
                                         const Atmosphere& atmosphere,
                                         std::span<const double> wavelengths,
                                         const Resolution& resolution);
Status keepScattering(const std::filesystem::path& folder, const Atmosphere& atmosphere,
                      const Scattering& scattering);

}  // namespace lambent::sky
