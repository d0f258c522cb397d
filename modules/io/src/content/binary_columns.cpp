#include "content/binary_columns.h"

#include "graben/core/threads.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>

namespace graben {
namespace {

constexpr std::size_t rows_per_block = 1 << 14;

template <typename Stored, bool turned>
double load(const char* bytes) {
  Stored value;
  if constexpr (turned) {
    std::array<char, sizeof(Stored)> native{};
    std::reverse_copy(bytes, bytes + sizeof(Stored), native.begin());
    std::memcpy(&value, native.data(), sizeof(value));
  } else {
    std::memcpy(&value, bytes, sizeof(value));
  }
  return static_cast<double>(value);
}

template <typename Number>
Number converted(double value) {
  if constexpr (std::is_same_v<Number, Index>)
    return std::abs(value) < 2e9 ? static_cast<Index>(value) : 0;
  else
    return static_cast<Number>(value);
}

template <typename Stored, typename Number>
void copyStored(const BinaryColumn& column, std::size_t begin, std::size_t end, Number* target, std::size_t target_stride) {
  const char* at = column.first + begin * column.stride;
  for (std::size_t i = 0; i < end - begin; ++i, at += column.stride)
    target[i * target_stride] = converted<Number>(column.big_endian ? load<Stored, true>(at) : load<Stored, false>(at));
}

/// x y z behind one another in a row, all of one type.
template <typename Stored>
void copyPacked(const char* at, std::size_t stride, std::size_t count, Vector3* target) {
  for (std::size_t i = 0; i < count; ++i, at += stride) {
    std::array<Stored, 3> v;
    std::memcpy(v.data(), at, sizeof(v));
    target[i] = {static_cast<double>(v[0]), static_cast<double>(v[1]), static_cast<double>(v[2])};
  }
}

bool isPacked(const BinaryVectors& v, BinaryType type) {
  const auto& c = v.columns;
  return c[0].type == type && c[1].type == type && c[2].type == type && !c[0].big_endian && c[1].first == c[0].first + sizeOf(type) &&
         c[2].first == c[1].first + sizeOf(type) && c[1].stride == c[0].stride && c[2].stride == c[0].stride;
}

void copyVectors(const BinaryVectors& vectors, std::size_t begin, std::size_t end) {
  Vector3* target = vectors.target->data() + begin;
  const BinaryColumn& x = vectors.columns[0];
  if (isPacked(vectors, BinaryType::Float32))
    return copyPacked<float>(x.first + begin * x.stride, x.stride, end - begin, target);
  if (isPacked(vectors, BinaryType::Float64))
    return copyPacked<double>(x.first + begin * x.stride, x.stride, end - begin, target);
  for (std::size_t k = 0; k < 3; ++k)
    readColumn(vectors.columns[k], begin, end, target->data() + k, 3);
}

} // namespace

BinaryRows BinaryRows::inFile(const FileContent& file, const char* first, std::size_t stride, std::size_t count) {
  BinaryRows rows;
  rows.count = count;
  rows.before = [&file, first, stride](std::size_t begin, std::size_t end) { file.load({first + begin * stride, (end - begin) * stride}); };
  rows.after = [&file, first, stride](std::size_t begin, std::size_t end) { file.release({first + begin * stride, (end - begin) * stride}); };
  return rows;
}

void forRows(const BinaryRows& rows, const std::function<void(std::size_t begin, std::size_t end)>& body) {
  parallelBlocks(rows.count, rows_per_block, rows.threads, [&](std::size_t begin, std::size_t end) {
    if (rows.before)
      rows.before(begin, end);
    body(begin, end);
    if (rows.after)
      rows.after(begin, end);
  });
}

void readVectors(const BinaryRows& rows, const std::vector<BinaryVectors>& vectors) {
  for (const BinaryVectors& v : vectors)
    v.target->resize(rows.count);
  forRows(rows, [&](std::size_t begin, std::size_t end) {
    for (const BinaryVectors& v : vectors)
      copyVectors(v, begin, end);
  });
}

template <typename Number>
void readColumn(const BinaryColumn& column, std::size_t begin, std::size_t end, Number* target, std::size_t target_stride) {
  switch (column.type) {
  case BinaryType::Int8:
    return copyStored<std::int8_t>(column, begin, end, target, target_stride);
  case BinaryType::UInt8:
    return copyStored<std::uint8_t>(column, begin, end, target, target_stride);
  case BinaryType::Int16:
    return copyStored<std::int16_t>(column, begin, end, target, target_stride);
  case BinaryType::UInt16:
    return copyStored<std::uint16_t>(column, begin, end, target, target_stride);
  case BinaryType::Int32:
    return copyStored<std::int32_t>(column, begin, end, target, target_stride);
  case BinaryType::UInt32:
    return copyStored<std::uint32_t>(column, begin, end, target, target_stride);
  case BinaryType::Int64:
    return copyStored<std::int64_t>(column, begin, end, target, target_stride);
  case BinaryType::UInt64:
    return copyStored<std::uint64_t>(column, begin, end, target, target_stride);
  case BinaryType::Float32:
    return copyStored<float>(column, begin, end, target, target_stride);
  case BinaryType::Float64:
    break;
  }
  copyStored<double>(column, begin, end, target, target_stride);
}

template void readColumn<double>(const BinaryColumn&, std::size_t, std::size_t, double*, std::size_t);
template void readColumn<float>(const BinaryColumn&, std::size_t, std::size_t, float*, std::size_t);
template void readColumn<Index>(const BinaryColumn&, std::size_t, std::size_t, Index*, std::size_t);

} // namespace graben
