#include "peer.h"

#include "mesh_cleaning.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <iostream>
#include <limits>
#include <sstream>
#include <stdexcept>
#include <thread>

namespace graben::peer {
namespace {

constexpr std::size_t kRows = 65536;

struct PcdHeader {
  std::size_t points = 0;
  std::size_t row = 0;
  std::array<std::size_t, 3> offset{};
  std::size_t real = 0; ///< bytes of a coordinate
};

PcdHeader readHeader(std::istream& in) {
  std::vector<std::string> fields;
  std::vector<std::size_t> sizes;
  PcdHeader header;
  for (std::string line; std::getline(in, line);) {
    std::istringstream words(line);
    std::string key;
    words >> key;
    if (key == "FIELDS")
      for (std::string name; words >> name;)
        fields.push_back(name);
    else if (key == "SIZE")
      for (std::size_t size = 0; words >> size;)
        sizes.push_back(size);
    else if (key == "POINTS")
      words >> header.points;
    else if (key == "DATA")
      break;
  }
  if (fields.size() != sizes.size())
    throw std::runtime_error("not a PCD");
  for (std::size_t i = 0; i < fields.size(); ++i) {
    if (fields[i].size() == 1 && fields[i][0] >= 'x' && fields[i][0] <= 'z') {
      header.offset[fields[i][0] - 'x'] = header.row;
      header.real = sizes[i];
    }
    header.row += sizes[i];
  }
  if (header.real != 4 && header.real != 8)
    throw std::runtime_error("no x y z");
  return header;
}

double coordinate(const PcdHeader& header, const char* row, int axis) {
  if (header.real == 8) {
    double value = 0;
    std::memcpy(&value, row + header.offset[axis], sizeof value);
    return value;
  }
  float value = 0;
  std::memcpy(&value, row + header.offset[axis], sizeof value);
  return value;
}

template <typename Row>
void forRows(std::istream& in, const PcdHeader& header, Row row) {
  std::vector<char> block(header.row * kRows);
  for (std::size_t first = 0; first < header.points; first += kRows) {
    const std::size_t rows = std::min(kRows, header.points - first);
    if (!in.read(block.data(), static_cast<std::streamsize>(rows * header.row)))
      throw std::runtime_error("the PCD is cut short");
    for (std::size_t i = 0; i < rows; ++i)
      row(block.data() + i * header.row);
  }
}

[[noreturn]] void usage(const char* program) {
  std::cerr << "Usage: " << program << " INPUT.pcd OUTPUT.ply --voxel H [--threads N] [--object] [--weld] [--trim D]\n";
  std::exit(2);
}

void put(std::vector<char>& block, const void* value, std::size_t size) {
  const char* bytes = static_cast<const char*>(value);
  block.insert(block.end(), bytes, bytes + size);
}

} // namespace

Arguments parseArguments(int argc, char** argv, bool needs_voxel) {
  Arguments arguments;
  for (int i = 1; i < argc; ++i) {
    const std::string word = argv[i];
    const bool has_value = i + 1 < argc;
    if (word == "--object")
      arguments.object = true;
    else if (word == "--weld")
      arguments.weld = true;
    else if (word == "--voxel" && has_value)
      arguments.voxel = std::atof(argv[++i]);
    else if (word == "--trim" && has_value)
      arguments.trim = std::atof(argv[++i]);
    else if (word == "--threads" && has_value)
      arguments.threads = std::atoi(argv[++i]);
    else if (word.rfind("--", 0) == 0 || !arguments.output.empty())
      usage(argv[0]);
    else
      (arguments.input.empty() ? arguments.input : arguments.output) = word;
  }
  if (arguments.output.empty() || ((needs_voxel || arguments.weld) && !(arguments.voxel > 0)))
    usage(argv[0]);
  if (arguments.threads <= 0)
    arguments.threads = static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
  return arguments;
}

Cloud readPcd(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  if (!in)
    throw std::runtime_error("cannot open " + path);
  const PcdHeader header = readHeader(in);
  const auto data = in.tellg();
  std::array<double, 3> low, high;
  low.fill(std::numeric_limits<double>::infinity());
  high.fill(-std::numeric_limits<double>::infinity());
  forRows(in, header, [&](const char* row) {
    for (int axis = 0; axis < 3; ++axis) {
      const double value = coordinate(header, row, axis);
      low[axis] = std::min(low[axis], value);
      high[axis] = std::max(high[axis], value);
    }
  });
  Cloud cloud;
  for (int axis = 0; axis < 3; ++axis) {
    cloud.origin[axis] = (low[axis] + high[axis]) / 2;
    cloud.size[axis] = static_cast<float>(high[axis] - low[axis]);
  }
  cloud.points.reserve(header.points);
  in.seekg(data);
  forRows(in, header, [&](const char* row) {
    Point point;
    for (int axis = 0; axis < 3; ++axis)
      point[axis] = static_cast<float>(coordinate(header, row, axis) - cloud.origin[axis]);
    cloud.points.push_back(point);
  });
  return cloud;
}

void writePly(const Arguments& arguments, const Cloud& cloud, Mesh& mesh) {
  if (arguments.trim > 0)
    trimFarTriangles(mesh, cloud.points, arguments.trim);
  if (arguments.weld)
    weldVertices(mesh, arguments.voxel / 1000);
  if (arguments.output == "-")
    return;
  std::ofstream out(arguments.output, std::ios::binary);
  const bool normals = mesh.normals.size() == mesh.vertices.size() && !mesh.normals.empty();
  out << "ply\nformat binary_little_endian 1.0\nelement vertex " << mesh.vertices.size()
      << "\nproperty double x\nproperty double y\nproperty double z\n"
      << (normals ? "property float nx\nproperty float ny\nproperty float nz\n" : "") << "element face " << mesh.triangles.size()
      << "\nproperty list uchar int vertex_indices\nend_header\n";
  std::vector<char> block;
  const auto flush = [&](bool last, std::size_t i) {
    if (last || (i + 1) % kRows == 0) {
      out.write(block.data(), static_cast<std::streamsize>(block.size()));
      block.clear();
    }
  };
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
    for (int axis = 0; axis < 3; ++axis) {
      const double value = mesh.vertices[i][axis] + cloud.origin[axis];
      put(block, &value, sizeof value);
    }
    if (normals)
      put(block, mesh.normals[i].data(), sizeof(Point));
    flush(i + 1 == mesh.vertices.size(), i);
  }
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    const unsigned char corners = 3;
    put(block, &corners, 1);
    put(block, mesh.triangles[i].data(), 3 * sizeof(std::int32_t));
    flush(i + 1 == mesh.triangles.size(), i);
  }
  if (!out.flush())
    throw std::runtime_error("cannot write " + arguments.output);
}

Point viewpoint(const Arguments& arguments, const Cloud& cloud) {
  constexpr float kFar = 1000; // times the size of the cloud
  return {0, 0, arguments.object ? 0 : kFar * std::max({cloud.size[0], cloud.size[1], cloud.size[2]})};
}

void Stopwatch::lap(const char* name) {
  const auto now = std::chrono::steady_clock::now();
  std::printf("time %s %.4f\n", name, std::chrono::duration<double>(now - last_).count());
  std::fflush(stdout);
  last_ = now;
}

int run(int argc, char** argv, bool needs_voxel, void (*body)(const Arguments&, const Cloud&, Mesh&)) try {
  const Arguments arguments = parseArguments(argc, argv, needs_voxel);
  Stopwatch watch;
  const Cloud cloud = readPcd(arguments.input);
  watch.lap("read");
  Mesh mesh;
  body(arguments, cloud, mesh);
  watch = Stopwatch();
  writePly(arguments, cloud, mesh);
  watch.lap("write");
  return 0;
} catch (const std::exception& error) {
  std::cerr << argv[0] << ": " << error.what() << '\n';
  return 1;
}

} // namespace graben::peer
