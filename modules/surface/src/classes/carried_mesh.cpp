#include "carried_mesh.h"

#include "graben/core/errors.h"
#include "graben/mesh/conversions.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <numeric>

namespace graben {

namespace {

using pcl::PCLPointField;

const char* const kStage = "reading a mesh";
const std::array<std::string, 3> kPosition = {"x", "y", "z"};
const std::array<std::string, 3> kNormal = {"normal_x", "normal_y", "normal_z"};

template <typename T>
T get(const std::uint8_t* at) {
  T value;
  std::memcpy(&value, at, sizeof(T));
  return value;
}

template <typename T>
void put(std::uint8_t* at, T value) {
  std::memcpy(at, &value, sizeof(T));
}

const PCLPointField* find(const pcl::PCLPointCloud2& cloud, const std::string& name) {
  const auto found = std::find_if(cloud.fields.begin(), cloud.fields.end(),
                                  [&](const PCLPointField& f) { return f.name == name; });
  return found == cloud.fields.end() ? nullptr : &*found;
}

bool isReal(const PCLPointField& field) {
  return field.datatype == PCLPointField::FLOAT32 || field.datatype == PCLPointField::FLOAT64;
}

double real(const std::uint8_t* point, const PCLPointField& field) {
  return field.datatype == PCLPointField::FLOAT64
             ? get<double>(point + field.offset)
             : static_cast<double>(get<float>(point + field.offset));
}

void putVector(pcl::PCLPointCloud2& cloud, const std::array<std::string, 3>& names,
               const Points& values) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const PCLPointField& field = *find(cloud, names[axis]);
    std::uint8_t* at = cloud.data.data() + field.offset;
    for (std::size_t v = 0; v < values.size(); ++v, at += cloud.point_step) {
      const double value = values[v][static_cast<int>(axis)];
      if (field.datatype == PCLPointField::FLOAT64)
        put(at, value);
      else
        put(at, static_cast<float>(value));
    }
  }
}

void setSize(pcl::PCLPointCloud2& cloud, std::size_t count) {
  const std::size_t bytes = count * cloud.point_step;
  if (bytes > std::numeric_limits<std::uint32_t>::max())
    throw InvalidInputError("writing a mesh",
                            "The mesh has more vertices than a PCL cloud can hold.");
  cloud.height = 1;
  cloud.width = static_cast<std::uint32_t>(count);
  cloud.row_step = static_cast<std::uint32_t>(bytes);
  cloud.is_dense = 1;
  cloud.data.resize(bytes);
}

} // namespace

CarriedMesh::CarriedMesh(const pcl::PolygonMesh& input)
    : mesh_(fromPolygonMesh(input))
    , points_(input.cloud) {
  compact();
  addNormalFields();
  findCarriers();
  mesh_.piece.resize(mesh_.vertices.size());
  std::iota(mesh_.piece.begin(), mesh_.piece.end(), Index{0});
  fillCarriers();
}

/// Leaves out what fromPolygonMesh leaves out, in the same order.
void CarriedMesh::compact() {
  const std::array<const PCLPointField*, 3> axes = {find(points_, "x"), find(points_, "y"),
                                                    find(points_, "z")};
  const std::size_t step = points_.point_step;
  const std::size_t row =
      std::max<std::size_t>(points_.height > 1 ? points_.row_step : 0, points_.width * step);
  std::size_t kept = 0;
  for (std::size_t j = 0; j < points_.height; ++j)
    for (std::size_t i = 0; i < points_.width; ++i) {
      const std::uint8_t* from = points_.data.data() + j * row + i * step;
      if (!std::all_of(axes.begin(), axes.end(),
                       [&](const PCLPointField* f) { return std::isfinite(real(from, *f)); }))
        continue;
      std::memmove(points_.data.data() + step * kept++, from, step);
    }
  setSize(points_, kept);
}

void CarriedMesh::addNormalFields() {
  const auto missing = [&](const std::string& name) {
    const PCLPointField* field = find(points_, name);
    return field == nullptr || !isReal(*field);
  };
  if (std::none_of(kNormal.begin(), kNormal.end(), missing))
    return;
  auto& fields = points_.fields;
  const auto ours = [](const PCLPointField& f) {
    return std::find(kNormal.begin(), kNormal.end(), f.name) != kNormal.end();
  };
  fields.erase(std::remove_if(fields.begin(), fields.end(), ours), fields.end());
  const std::uint32_t step = points_.point_step;
  for (std::uint32_t axis = 0; axis < 3; ++axis) {
    PCLPointField field;
    field.name = kNormal[axis];
    field.offset = step + 4 * axis;
    field.datatype = PCLPointField::FLOAT32;
    field.count = 1;
    fields.push_back(field);
  }
  const std::vector<std::uint8_t> old(points_.data.begin(), points_.data.end());
  points_.point_step = step + 12;
  setSize(points_, points_.width);
  for (std::size_t v = 0; v < points_.width; ++v)
    std::memcpy(points_.data.data() + v * points_.point_step, old.data() + v * step, step);
}

void CarriedMesh::addCarriers(const PCLPointField& field, Kind kind, std::size_t count,
                              std::size_t size) {
  if (field.offset + count * size > points_.point_step)
    throw InvalidInputError(kStage,
                            "The field " + field.name + " reaches past the end of a point.");
  for (std::size_t i = 0; i < count; ++i)
    carriers_.push_back({kind, field.offset + i * size, std::to_string(carriers_.size())});
}

void CarriedMesh::findCarriers() {
  for (const PCLPointField& field : points_.fields) {
    const std::size_t count = std::max<std::size_t>(field.count, 1);
    if (std::find(kPosition.begin(), kPosition.end(), field.name) != kPosition.end() ||
        std::find(kNormal.begin(), kNormal.end(), field.name) != kNormal.end())
      continue;
    if (field.name == "rgb" || field.name == "rgba")
      addCarriers(field, Kind::Channel, 4, 1);
    else if (field.datatype == PCLPointField::FLOAT32)
      addCarriers(field, Kind::Float, count, sizeof(float));
    else if (field.datatype == PCLPointField::FLOAT64)
      addCarriers(field, Kind::Double, count, sizeof(double));
  }
}

void CarriedMesh::fillCarriers() {
  mesh_.scalars.clear();
  for (const Carrier& carrier : carriers_) {
    std::vector<float>& high = mesh_.scalars[carrier.name];
    high.resize(points_.width);
    std::vector<float> low(carrier.kind == Kind::Double ? points_.width : 0);
    const std::uint8_t* at = points_.data.data() + carrier.offset;
    for (std::size_t v = 0; v < points_.width; ++v, at += points_.point_step) {
      if (carrier.kind == Kind::Float) {
        high[v] = get<float>(at);
      } else if (carrier.kind == Kind::Channel) {
        high[v] = static_cast<float>(*at);
      } else {
        high[v] = static_cast<float>(get<double>(at));
        low[v] = static_cast<float>(get<double>(at) - static_cast<double>(high[v]));
      }
    }
    if (carrier.kind == Kind::Double)
      mesh_.scalars[carrier.name + " low"] = std::move(low);
  }
}

void CarriedMesh::writeCarrier(const Carrier& carrier, const TriangleMesh& result,
                               std::size_t first, pcl::PCLPointCloud2& cloud) const {
  const std::vector<float>& values = result.scalars.at(carrier.name);
  for (std::size_t v = first; v < values.size(); ++v) {
    std::uint8_t* at = cloud.data.data() + v * cloud.point_step + carrier.offset;
    if (carrier.kind == Kind::Float)
      put(at, values[v]);
    else if (carrier.kind == Kind::Channel)
      *at = static_cast<std::uint8_t>(std::lround(std::clamp(values[v], 0.0F, 255.0F)));
    else
      put(at, static_cast<double>(values[v]) +
                  static_cast<double>(result.scalars.at(carrier.name + " low")[v]));
  }
}

void CarriedMesh::write(const TriangleMesh& result, pcl::PolygonMesh& out) const {
  pcl::PCLPointCloud2 cloud = points_;
  setSize(cloud, result.vertices.size());
  for (std::size_t v = points_.width; v < result.vertices.size(); ++v)
    std::memcpy(cloud.data.data() + v * cloud.point_step,
                points_.data.data() +
                    static_cast<std::size_t>(result.piece[v]) * points_.point_step,
                cloud.point_step);
  for (const Carrier& carrier : carriers_)
    writeCarrier(carrier, result, points_.width, cloud);
  putVector(cloud, kPosition, result.vertices);
  putVector(cloud, kNormal, result.normals);
  out.cloud = std::move(cloud);
  out.polygons.assign(result.triangles.size(), pcl::Vertices());
  for (std::size_t t = 0; t < result.triangles.size(); ++t)
    out.polygons[t].vertices.assign(result.triangles[t].begin(), result.triangles[t].end());
}

} // namespace graben
