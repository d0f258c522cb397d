#pragma once

#include "content/binary_value.h"

#include "graben/core/types.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace graben {

struct PlyProperty {
  std::string name;
  BinaryType type = BinaryType::Float32;
  bool is_list = false;
  BinaryType count_type = BinaryType::UInt8; ///< of a list
};

struct PlyElement {
  std::string name;
  std::uint64_t count = 0;
  std::vector<PlyProperty> properties;
};

enum class PlyEncoding { Ascii, LittleEndian, BigEndian };

struct PlyHeader {
  PlyEncoding encoding = PlyEncoding::Ascii;
  std::vector<PlyElement> elements;
  std::optional<Vector3> origin; ///< `comment origin X Y Z`: to be added to all positions
  std::size_t body = 0;      ///< offset of the first byte after the header
  std::size_t body_line = 0; ///< number of the first line after the header
};

/// \throw ParseError if the header is not one of PLY 1.0 or a count cannot fit into the file
PlyHeader readPlyHeader(std::string_view bytes, const std::string& path);

} // namespace graben
