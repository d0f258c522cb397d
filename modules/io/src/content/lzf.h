#pragma once

#include <cstddef>
#include <string_view>

namespace graben {

/// Unpacks a block compressed with LZF, as in binary_compressed PCD files. (PCL's own function would link its io library, which loads dozens of others.)
/// \param[out] out room for \a size bytes
/// \return false if the block is damaged or does not hold exactly \a size bytes; what \a out holds is then undefined
bool unpackLzf(std::string_view packed, char* out, std::size_t size);

} // namespace graben
