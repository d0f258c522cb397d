#include "graben/io/ply_cloud_writer.h"

#include "graben/core/atomic_file.h"
#include "graben/core/errors.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstring>
#include <pcl/PCLPointCloud2.h>
#include <set>

namespace graben {
namespace {

using Field = pcl::PCLPointField;

/// One property of the PLY vertices.
struct Property {
  std::string name;
  std::size_t offset = 0;    ///< in a point of the cloud
  int type = Field::FLOAT32; ///< in the cloud
  int written = Field::FLOAT32;
  bool shifted = false; ///< by added
  double added = 0.0;
};

std::size_t sizeOfType(int type) {
  switch (type) {
  case Field::INT8:
  case Field::UINT8:
  case Field::BOOL:
    return 1;
  case Field::INT16:
  case Field::UINT16:
    return 2;
  case Field::INT32:
  case Field::UINT32:
  case Field::FLOAT32:
    return 4;
  case Field::FLOAT64:
  case Field::INT64:
  case Field::UINT64:
    return 8;
  default:
    return 0;
  }
}

const char* plyName(int type) {
  static const std::array<const char*, 9> names = {"",    "char", "uchar", "short", "ushort",
                                                   "int", "uint", "float", "double"};
  return names[static_cast<std::size_t>(type)];
}

int writtenType(int type) {
  if (type == Field::BOOL)
    return Field::UINT8;
  return type == Field::INT64 || type == Field::UINT64 ? static_cast<int>(Field::FLOAT64) : type;
}

template <typename Number>
Number load(const std::uint8_t* bytes) {
  Number value;
  std::memcpy(&value, bytes, sizeof(value));
  return value;
}

double valueOf(const std::uint8_t* bytes, int type) {
  switch (type) {
  case Field::INT8:
    return load<std::int8_t>(bytes);
  case Field::INT16:
    return load<std::int16_t>(bytes);
  case Field::UINT16:
    return load<std::uint16_t>(bytes);
  case Field::INT32:
    return load<std::int32_t>(bytes);
  case Field::UINT32:
    return load<std::uint32_t>(bytes);
  case Field::FLOAT32:
    return load<float>(bytes);
  case Field::FLOAT64:
    return load<double>(bytes);
  case Field::INT64:
    return static_cast<double>(load<std::int64_t>(bytes));
  case Field::UINT64:
    return static_cast<double>(load<std::uint64_t>(bytes));
  default:
    return load<std::uint8_t>(bytes);
  }
}

class PlyCloudWriter {
public:
  PlyCloudWriter(const std::string& path, const pcl::PCLPointCloud2& cloud,
                 const PlyCloudOptions& options)
      : path_(path)
      , cloud_(cloud)
      , options_(options) {}

  PlyCloudReport write();

private:
  [[noreturn]] void refuse(const std::string& message) const {
    throw InvalidInputError("writing " + path_, message);
  }
  void checkCloud() const;
  void plan();
  void planField(const Field& field);
  void addProperty(const std::string& name, std::size_t offset, int type);
  void selectPoints();
  void selectFaces();
  std::string header() const;
  std::string camera() const;
  const std::uint8_t* point(std::size_t i) const;
  void appendBinary(std::string& row, const std::uint8_t* point) const;
  void appendText(std::string& row, const std::uint8_t* point) const;

  const std::string& path_;
  const pcl::PCLPointCloud2& cloud_;
  const PlyCloudOptions& options_;
  std::vector<Property> properties_;
  std::array<Property, 3> position_;
  std::set<std::string> names_;
  std::vector<std::size_t> points_; ///< those written
  std::vector<Triangle> faces_;     ///< over those written
  PlyCloudReport report_;
};

void PlyCloudWriter::checkCloud() const {
  if (cloud_.is_bigendian != 0)
    refuse("the cloud is big endian");
  for (const Field& field : cloud_.fields) {
    const std::uint64_t size =
        std::uint64_t{sizeOfType(field.datatype)} * std::max(field.count, 1U);
    if (size == 0 || field.offset + size > cloud_.point_step)
      refuse("field " + field.name + " has an unknown type or lies outside the point");
  }
  const std::uint64_t row = std::uint64_t{cloud_.width} * cloud_.point_step;
  const bool rows_fit = cloud_.height < 2 || cloud_.row_step >= row;
  const std::uint64_t rest =
      cloud_.height < 2 ? 0 : std::uint64_t{cloud_.height - 1} * cloud_.row_step;
  if (!rows_fit || (cloud_.height > 0 && rest + row > cloud_.data.size()))
    refuse("the cloud's data are shorter than its size says");
}

void PlyCloudWriter::addProperty(const std::string& name, std::size_t offset, int type) {
  std::string word = name;
  std::replace_if(
      word.begin(), word.end(), [](unsigned char c) { return c <= ' ' || c == 0x7F; }, '_');
  while (word.empty() || !names_.insert(word).second)
    word += '_';
  properties_.push_back({word, offset, type, writtenType(type), false, 0.0});
}

void PlyCloudWriter::planField(const Field& field) {
  if (field.name == "_")
    return;
  const bool packed = field.count <= 1 && sizeOfType(field.datatype) == 4;
  if ((field.name == "rgb" || field.name == "rgba") && packed) {
    // Packed as 0xAARRGGBB, little endian.
    addProperty("red", field.offset + 2, Field::UINT8);
    addProperty("green", field.offset + 1, Field::UINT8);
    addProperty("blue", field.offset, Field::UINT8);
    if (field.name == "rgba")
      addProperty("alpha", field.offset + 3, Field::UINT8);
    return;
  }
  const bool normal = field.name.size() == 8 && field.name.compare(0, 7, "normal_") == 0 &&
                      field.name.back() >= 'x' && field.name.back() <= 'z';
  const std::string name = normal ? std::string("n") + field.name.back() : field.name;
  if (field.count <= 1)
    addProperty(name, field.offset, field.datatype);
  for (std::size_t i = 0; field.count > 1 && i < field.count; ++i)
    addProperty(name + "_" + std::to_string(i), field.offset + i * sizeOfType(field.datatype),
                field.datatype);
}

void PlyCloudWriter::plan() {
  for (const Field& field : cloud_.fields)
    planField(field);
  static const std::array<const char*, 3> axes = {"x", "y", "z"};
  for (std::size_t k = 0; k < 3; ++k) {
    const auto axis = std::find_if(properties_.begin(), properties_.end(),
                                   [&](const Property& p) { return p.name == axes[k]; });
    if (axis == properties_.end())
      refuse(std::string("the cloud has no field ") + axes[k]);
    if (options_.origin) {
      axis->added = (*options_.origin)[static_cast<Eigen::Index>(k)];
      axis->shifted = true;
      axis->written = Field::FLOAT64;
    }
    position_[k] = *axis;
  }
}

const std::uint8_t* PlyCloudWriter::point(std::size_t i) const {
  const std::size_t row = cloud_.height < 2 ? 0 : i / cloud_.width;
  return cloud_.data.data() + row * cloud_.row_step + (i - row * cloud_.width) * cloud_.point_step;
}

void PlyCloudWriter::selectPoints() {
  const std::size_t count = std::size_t{cloud_.width} * cloud_.height;
  points_.reserve(count);
  for (std::size_t i = 0; i < count; ++i) {
    const bool finite = std::all_of(position_.begin(), position_.end(), [&](const Property& p) {
      return std::isfinite(valueOf(point(i) + p.offset, p.type));
    });
    if (finite || !options_.drop_nan)
      points_.push_back(i);
  }
  report_.points = points_.size();
  report_.dropped_points = count - points_.size();
}

void PlyCloudWriter::selectFaces() {
  const std::size_t count = std::size_t{cloud_.width} * cloud_.height;
  std::vector<Index> new_index(options_.faces.empty() ? 0 : count, -1);
  for (std::size_t i = 0; !new_index.empty() && i < points_.size(); ++i)
    new_index[points_[i]] = static_cast<Index>(i);
  for (const Triangle& face : options_.faces) {
    Triangle kept{};
    for (std::size_t c = 0; c < 3; ++c) {
      if (face[c] < 0 || static_cast<std::size_t>(face[c]) >= count)
        refuse("a face names point " + std::to_string(face[c]) + " of " + std::to_string(count));
      kept[c] = new_index[static_cast<std::size_t>(face[c])];
    }
    if (*std::min_element(kept.begin(), kept.end()) >= 0)
      faces_.push_back(kept);
  }
  report_.faces = faces_.size();
  report_.dropped_faces = options_.faces.size() - faces_.size();
}

template <typename Number>
void appendShortest(std::string& row, Number value) {
  std::array<char, 64> digits{};
  const auto result = std::to_chars(digits.data(), digits.data() + digits.size(), value);
  row.append(digits.data(), result.ptr);
}

std::string PlyCloudWriter::header() const {
  std::string text = "ply\nformat ";
  text += options_.ascii ? "ascii" : "binary_little_endian";
  text += " 1.0\n";
  if (cloud_.height > 1 && report_.dropped_points == 0 && options_.faces.empty())
    text += "obj_info num_cols " + std::to_string(cloud_.width) + "\nobj_info num_rows " + std::to_string(cloud_.height) + "\n";
  text += "element vertex " + std::to_string(points_.size()) + "\n";
  for (const Property& p : properties_)
    text += std::string("property ") + plyName(p.written) + " " + p.name + "\n";
  if (!options_.faces.empty())
    text += "element face " + std::to_string(faces_.size()) +
            "\nproperty list uchar int vertex_indices\n";
  if (options_.viewpoint) {
    text += "element camera 1\n";
    for (const char* name : {"view_px", "view_py", "view_pz", "x_axisx", "x_axisy", "x_axisz", "y_axisx", "y_axisy", "y_axisz", "z_axisx", "z_axisy", "z_axisz",
                             "focal", "scalex", "scaley", "centerx", "centery"})
      text += std::string("property float ") + name + "\n";
    text += "property int viewportx\nproperty int viewporty\nproperty float k1\nproperty float k2\n";
  }
  return text + "end_header\n";
}

/// The camera's place, axes and what PCL puts for a lens that is not known.
std::string PlyCloudWriter::camera() const {
  std::vector<float> values;
  const Vector3 place = options_.viewpoint->position + options_.origin.value_or(Vector3::Zero());
  const Eigen::Matrix3d axes = options_.viewpoint->orientation.toRotationMatrix();
  for (const double coordinate : place)
    values.push_back(static_cast<float>(coordinate));
  for (Eigen::Index axis = 0; axis < 3; ++axis)
    for (Eigen::Index k = 0; k < 3; ++k)
      values.push_back(static_cast<float>(axes(k, axis)));
  values.insert(values.end(), {0.0F, 0.0F, 0.0F, 0.0F, 0.0F});
  const std::array<std::int32_t, 2> viewport{static_cast<std::int32_t>(cloud_.width), static_cast<std::int32_t>(cloud_.height)};
  std::string text;
  if (options_.ascii) {
    for (const float value : values) {
      appendShortest(text, value);
      text += ' ';
    }
    return text + std::to_string(viewport[0]) + " " + std::to_string(viewport[1]) + " 0 0\n";
  }
  text.append(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(float));
  text.append(reinterpret_cast<const char*>(viewport.data()), sizeof(viewport));
  return text.append(2 * sizeof(float), '\0');
}

void PlyCloudWriter::appendBinary(std::string& row, const std::uint8_t* point) const {
  for (const Property& p : properties_) {
    const std::uint8_t* bytes = point + p.offset;
    if (p.shifted || (p.written == Field::FLOAT64 && p.type != Field::FLOAT64)) {
      const double value = valueOf(bytes, p.type) + p.added;
      row.append(reinterpret_cast<const char*>(&value), sizeof(value));
    } else {
      row.append(reinterpret_cast<const char*>(bytes), sizeOfType(p.type));
    }
  }
}

void PlyCloudWriter::appendText(std::string& row, const std::uint8_t* point) const {
  for (const Property& p : properties_) {
    if (&p != properties_.data())
      row += ' ';
    const double value = valueOf(point + p.offset, p.type) + p.added;
    if (p.written == Field::FLOAT32)
      appendShortest(row, static_cast<float>(value));
    else if (p.written == Field::FLOAT64)
      appendShortest(row, value);
    else
      appendShortest(row, static_cast<std::int64_t>(value));
  }
  row += '\n';
}

PlyCloudReport PlyCloudWriter::write() {
  checkCloud();
  plan();
  selectPoints();
  selectFaces();
  AtomicFile file(path_);
  file.write(header());
  std::string row;
  for (const std::size_t i : points_) {
    row.clear();
    options_.ascii ? appendText(row, point(i)) : appendBinary(row, point(i));
    file.write(row);
  }
  for (const Triangle& face : faces_) {
    if (options_.ascii) {
      file.write("3 " + std::to_string(face[0]) + " " + std::to_string(face[1]) + " " +
                 std::to_string(face[2]) + "\n");
    } else {
      file.write("\3");
      file.writeRaw(face);
    }
  }
  if (options_.viewpoint)
    file.write(camera());
  file.commit();
  return report_;
}

} // namespace

PlyCloudReport writePlyCloud(const std::string& path, const pcl::PCLPointCloud2& cloud,
                             const PlyCloudOptions& options) {
  return PlyCloudWriter(path, cloud, options).write();
}

} // namespace graben
