#include "graben/mesh/conversions.h"

#include "graben/core/errors.h"

#include <cmath>
#include <cstring>
#include <set>

namespace graben {

namespace {

using pcl::PCLPointField;

const char* const kStage = "converting a mesh";
const std::array<const char*, 3> kAxes{"x", "y", "z"};
const std::array<const char*, 3> kNormalAxes{"normal_x", "normal_y", "normal_z"};
const char* const kLabel = "label";

std::uint32_t addField(pcl::PCLPointCloud2& cloud, const std::string& name, std::uint8_t type) {
  PCLPointField field;
  field.name = name;
  field.offset = cloud.point_step;
  field.datatype = type;
  field.count = 1;
  cloud.fields.push_back(field);
  cloud.point_step += 4;
  return field.offset;
}

void layOutFields(const TriangleMesh& mesh, pcl::PCLPointCloud2& cloud) {
  cloud.fields.clear();
  cloud.point_step = 0;
  for (const char* axis : kAxes)
    addField(cloud, axis, PCLPointField::FLOAT32);
  if (!mesh.normals.empty())
    for (const char* axis : kNormalAxes)
      addField(cloud, axis, PCLPointField::FLOAT32);
  if (!mesh.piece.empty())
    addField(cloud, kLabel, PCLPointField::UINT32);
  for (const auto& scalar : mesh.scalars)
    if (!scalar.second.empty())
      addField(cloud, scalar.first, PCLPointField::FLOAT32);
}

void checkNames(const TriangleMesh& mesh) {
  std::set<std::string> reserved{kLabel};
  reserved.insert(kAxes.begin(), kAxes.end());
  reserved.insert(kNormalAxes.begin(), kNormalAxes.end());
  for (const auto& scalar : mesh.scalars)
    if (reserved.count(scalar.first) != 0)
      throw InvalidInputError(kStage, "a scalar field cannot have the name " + scalar.first);
}

template <typename T>
std::uint8_t* put(std::uint8_t* at, T value) {
  std::memcpy(at, &value, sizeof(T));
  return at + sizeof(T);
}

std::uint8_t* putVector(std::uint8_t* at, const Vector3& v) {
  for (int axis = 0; axis < 3; ++axis)
    at = put(at, static_cast<float>(v[axis]));
  return at;
}

const PCLPointField* findField(const pcl::PCLPointCloud2& cloud, const std::string& name) {
  for (const PCLPointField& field : cloud.fields)
    if (field.name == name)
      return &field;
  return nullptr;
}

bool isReal(const PCLPointField* field) {
  return field != nullptr &&
         (field->datatype == PCLPointField::FLOAT32 || field->datatype == PCLPointField::FLOAT64);
}

double realAt(const std::uint8_t* point, const PCLPointField& field) {
  if (field.datatype == PCLPointField::FLOAT64) {
    double value = 0.0;
    std::memcpy(&value, point + field.offset, sizeof value);
    return value;
  }
  float value = 0.0F;
  std::memcpy(&value, point + field.offset, sizeof value);
  return value;
}

/// Three fields read as one vector; empty() if one of them is missing or not real.
struct VectorFields {
  std::array<const PCLPointField*, 3> fields{};

  VectorFields(const pcl::PCLPointCloud2& cloud, const std::array<const char*, 3>& names) {
    for (std::size_t i = 0; i < 3; ++i)
      fields[i] = findField(cloud, names[i]);
  }
  bool empty() const { return !isReal(fields[0]) || !isReal(fields[1]) || !isReal(fields[2]); }
  Vector3 at(const std::uint8_t* point) const {
    return {realAt(point, *fields[0]), realAt(point, *fields[1]), realAt(point, *fields[2])};
  }
};

/// Four-byte fields other than coordinates, normals and label that hold one float32 each.
std::vector<const PCLPointField*> scalarFields(const pcl::PCLPointCloud2& cloud) {
  std::set<std::string> taken{kLabel, "_"};
  taken.insert(kAxes.begin(), kAxes.end());
  taken.insert(kNormalAxes.begin(), kNormalAxes.end());
  std::vector<const PCLPointField*> result;
  for (const PCLPointField& field : cloud.fields)
    if (field.datatype == PCLPointField::FLOAT32 && field.count <= 1 &&
        taken.insert(field.name).second)
      result.push_back(&field);
  return result;
}

/// Byte distance of rows, after a check that every point with all its fields lies inside the data.
std::size_t checkedRowStep(const pcl::PCLPointCloud2& cloud) {
  const std::size_t row = std::size_t{cloud.width} * cloud.point_step;
  const std::size_t step = cloud.height > 1 && cloud.row_step > row ? cloud.row_step : row;
  const std::size_t needed =
      cloud.height == 0 || cloud.width == 0 ? 0 : step * (cloud.height - 1) + row;
  if (cloud.data.size() < needed)
    throw InvalidInputError(kStage, "the cloud says it has " + std::to_string(cloud.width) + " x " +
                                        std::to_string(cloud.height) +
                                        " points, but its data are shorter");
  for (const PCLPointField& field : cloud.fields) {
    const std::size_t size = field.datatype == PCLPointField::FLOAT64 ? 8 : 4;
    const bool read = field.datatype == PCLPointField::FLOAT32 || size == 8 || field.name == kLabel;
    if (read && field.offset + size > cloud.point_step)
      throw InvalidInputError(kStage,
                              "the field " + field.name + " reaches past the end of a point");
  }
  return step;
}

/// Appends the points of the cloud. \return the vertex of every point, -1 for one that is not
/// finite
std::vector<Index> readVertices(const pcl::PCLPointCloud2& cloud, TriangleMesh& out) {
  const VectorFields position(cloud, kAxes);
  if (position.empty())
    throw InvalidInputError(kStage, "the cloud has no float fields x, y and z");
  const VectorFields normal(cloud, kNormalAxes);
  const PCLPointField* label = findField(cloud, kLabel);
  const bool has_label = label != nullptr && (label->datatype == PCLPointField::UINT32 ||
                                              label->datatype == PCLPointField::INT32);
  const std::vector<const PCLPointField*> scalars = scalarFields(cloud);
  const std::size_t row_step = checkedRowStep(cloud);
  std::vector<Index> vertex;
  vertex.reserve(std::size_t{cloud.width} * cloud.height);
  for (std::size_t row = 0; row < cloud.height; ++row)
    for (std::size_t column = 0; column < cloud.width; ++column) {
      const std::uint8_t* point = cloud.data.data() + row * row_step + column * cloud.point_step;
      const Vector3 p = position.at(point);
      vertex.push_back(p.allFinite() ? static_cast<Index>(out.vertices.size()) : -1);
      if (!p.allFinite())
        continue;
      out.vertices.push_back(p);
      if (!normal.empty())
        out.normals.push_back(normal.at(point));
      if (has_label)
        std::memcpy(&out.piece.emplace_back(), point + label->offset, sizeof(Index));
      for (const PCLPointField* field : scalars)
        std::memcpy(&out.scalars[field->name].emplace_back(), point + field->offset, sizeof(float));
    }
  return vertex;
}

bool cornersExist(const pcl::Vertices& polygon, const std::vector<Index>& vertex) {
  for (const auto corner : polygon.vertices)
    if (corner < 0 || static_cast<std::size_t>(corner) >= vertex.size() ||
        vertex[static_cast<std::size_t>(corner)] < 0)
      return false;
  return polygon.vertices.size() >= 3;
}

} // namespace

void toPolygonMesh(const TriangleMesh& mesh, pcl::PolygonMesh& out) {
  validate(mesh, kStage);
  checkNames(mesh);
  pcl::PCLPointCloud2& cloud = out.cloud;
  layOutFields(mesh, cloud);
  const std::size_t bytes = mesh.vertices.size() * cloud.point_step;
  if (bytes > std::numeric_limits<std::uint32_t>::max())
    throw InvalidInputError(kStage, "the mesh has more vertices than a PCL cloud can hold");
  cloud.height = 1;
  cloud.width = static_cast<std::uint32_t>(mesh.vertices.size());
  cloud.row_step = static_cast<std::uint32_t>(bytes);
  cloud.is_bigendian = 0;
  cloud.is_dense = 1;
  cloud.data.resize(bytes);
  std::uint8_t* at = cloud.data.data();
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
    at = putVector(at, mesh.vertices[v]);
    if (!mesh.normals.empty())
      at = putVector(at, mesh.normals[v]);
    if (!mesh.piece.empty())
      at = put(at, static_cast<std::uint32_t>(mesh.piece[v]));
    for (const auto& scalar : mesh.scalars)
      if (!scalar.second.empty())
        at = put(at, scalar.second[v]);
  }
  out.polygons.assign(mesh.triangles.size(), pcl::Vertices());
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    out.polygons[t].vertices.assign(mesh.triangles[t].begin(), mesh.triangles[t].end());
}

void toPolygonMesh(const SealedMesh& mesh, Index block, const Vector3& origin, pcl::PolygonMesh& out) {
  if (block < 0 || static_cast<std::size_t>(block) >= mesh.blocks.size())
    throw InvalidInputError(kStage, "there is no block " + std::to_string(block) + "; the model has " + std::to_string(mesh.blocks.size()));
  TriangleMesh surface = blockSurface(mesh, block);
  for (Vector3& p : surface.vertices)
    p -= origin;
  toPolygonMesh(surface, out);
}

TriangleMesh fromPolygonMesh(const pcl::PolygonMesh& mesh) {
  TriangleMesh out;
  const std::vector<Index> vertex = readVertices(mesh.cloud, out);
  out.triangles.reserve(mesh.polygons.size());
  for (const pcl::Vertices& polygon : mesh.polygons) {
    if (!cornersExist(polygon, vertex))
      continue;
    const auto at = [&](std::size_t i) {
      return vertex[static_cast<std::size_t>(polygon.vertices[i])];
    };
    for (std::size_t i = 2; i < polygon.vertices.size(); ++i)
      out.triangles.push_back({at(0), at(i - 1), at(i)});
  }
  return out;
}

} // namespace graben
