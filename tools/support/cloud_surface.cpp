#include "support/cloud_surface.h"

#include "graben/core/errors.h"
#include "graben/features/neighbor_grid.h"

#include <array>
#include <cstring>

namespace graben {
namespace {

constexpr const char* kStage = "reconstructing the cloud's surface";

using Field = pcl::PCLPointField;

const Field* findField(const pcl::PCLPointCloud2& cloud, const std::string& name) {
  for (const Field& field : cloud.fields)
    if (field.name == name && (field.datatype == Field::FLOAT32 || field.datatype == Field::FLOAT64))
      return &field;
  return nullptr;
}

/// Three floating point fields of a cloud that make a vector.
class VectorFields {
public:
  VectorFields(const pcl::PCLPointCloud2& cloud, const std::array<const char*, 3>& names) {
    for (std::size_t i = 0; i < 3; ++i)
      fields_[i] = findField(cloud, names[i]);
  }

  bool complete() const { return fields_[0] != nullptr && fields_[1] != nullptr && fields_[2] != nullptr; }

  Vector3 read(const std::uint8_t* point) const {
    Vector3 out;
    for (Eigen::Index i = 0; i < 3; ++i) {
      const Field& field = *fields_[static_cast<std::size_t>(i)];
      if (field.datatype == Field::FLOAT64) {
        std::memcpy(&out[i], point + field.offset, sizeof(double));
      } else {
        float value = 0.0F;
        std::memcpy(&value, point + field.offset, sizeof value);
        out[i] = value;
      }
    }
    return out;
  }

  void write(const Vector3& value, std::uint8_t* point) const {
    for (Eigen::Index i = 0; i < 3; ++i) {
      const Field& field = *fields_[static_cast<std::size_t>(i)];
      if (field.datatype == Field::FLOAT64) {
        std::memcpy(point + field.offset, &value[i], sizeof(double));
      } else {
        const auto single = static_cast<float>(value[i]);
        std::memcpy(point + field.offset, &single, sizeof single);
      }
    }
  }

private:
  std::array<const Field*, 3> fields_{};
};

constexpr std::array<const char*, 3> kPosition = {"x", "y", "z"};
constexpr std::array<const char*, 3> kNormal = {"normal_x", "normal_y", "normal_z"};

Points positions(const pcl::PCLPointCloud2& cloud) {
  const VectorFields position(cloud, kPosition);
  if (!position.complete())
    throw InvalidInputError(kStage, "the cloud needs x, y and z as floating point numbers");
  Points points;
  const std::size_t count = static_cast<std::size_t>(cloud.width) * cloud.height;
  for (std::size_t i = 0; i < count; ++i)
    points.push_back(position.read(&cloud.data[i * cloud.point_step]));
  return points;
}

/// The fields of \a source with normals, and room for \a count points.
pcl::PCLPointCloud2 emptyCloud(const pcl::PCLPointCloud2& source, std::size_t count) {
  pcl::PCLPointCloud2 out;
  out.header = source.header;
  out.fields = source.fields;
  out.point_step = source.point_step;
  if (!VectorFields(source, kNormal).complete())
    for (const char* name : kNormal) {
      Field field;
      field.name = name;
      field.offset = out.point_step;
      field.datatype = Field::FLOAT32;
      field.count = 1;
      out.fields.push_back(field);
      out.point_step += static_cast<std::uint32_t>(sizeof(float));
    }
  out.width = static_cast<std::uint32_t>(count);
  out.height = 1;
  out.row_step = out.width * out.point_step;
  out.is_dense = true;
  out.data.resize(count * out.point_step);
  return out;
}

} // namespace

CloudSurface reconstructCloud(const pcl::PCLPointCloud2& cloud, const ReconstructionOptions& options) {
  const Points points = positions(cloud);
  const TriangleMesh mesh = HorizonReconstruction(options).reconstruct(points).mesh;
  const NeighborGrid nearby(points, 0.0, options.threads);
  CloudSurface surface{emptyCloud(cloud, mesh.vertices.size()), mesh.triangles};
  const VectorFields position(surface.cloud, kPosition);
  const VectorFields normal(surface.cloud, kNormal);
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
    std::uint8_t* vertex = &surface.cloud.data[i * surface.cloud.point_step];
    const auto nearest = static_cast<std::size_t>(nearby.nearestOne(mesh.vertices[i]).index);
    std::memcpy(vertex, &cloud.data[nearest * cloud.point_step], cloud.point_step);
    position.write(mesh.vertices[i], vertex);
    normal.write(mesh.normals[i], vertex);
  }
  return surface;
}

} // namespace graben
