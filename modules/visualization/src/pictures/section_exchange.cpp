#include "graben/visualization/section_drawing.h"

#include <algorithm>
#include <cctype>
#include <cstdio>

namespace graben {

namespace {

std::string number(double value) {
  char text[40];
  std::snprintf(text, sizeof(text), "%.10g", value);
  return text;
}

/// Names of layers in R12: capitals, digits, - and _.
std::string layerName(const std::string& name) {
  std::string result;
  for (const char c : name)
    result += std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '-' ? static_cast<char>(std::toupper(static_cast<unsigned char>(c))) : '_';
  return result.empty() ? "0" : result;
}

class DxfWriter {
public:
  explicit DxfWriter(const SectionDrawing& drawing) : d_(drawing), z_factor_(drawing.z_positive == ZPositive::Down ? -1.0 : 1.0) {}

  std::string write() {
    out_ = "0\nSECTION\n2\nHEADER\n9\n$ACADVER\n1\nAC1009\n0\nENDSEC\n";
    std::vector<std::string> names;
    for (const DrawnArea& area : d_.areas)
      names.push_back(areaLayer(area));
    for (const DrawnLine& line : d_.lines)
      names.push_back(lineLayer(line));
    std::sort(names.begin(), names.end());
    names.erase(std::unique(names.begin(), names.end()), names.end());
    out_ += "0\nSECTION\n2\nTABLES\n0\nTABLE\n2\nLAYER\n70\n" + std::to_string(names.size()) + "\n";
    for (std::size_t i = 0; i < names.size(); ++i)
      out_ += "0\nLAYER\n2\n" + names[i] + "\n70\n0\n62\n" + std::to_string(1 + i % 250) + "\n6\nCONTINUOUS\n";
    out_ += "0\nENDTAB\n0\nENDSEC\n0\nSECTION\n2\nENTITIES\n";
    for (const DrawnArea& area : d_.areas)
      for (const auto& ring : area.rings)
        add(areaLayer(area), ring, true);
    for (const DrawnLine& line : d_.lines)
      add(lineLayer(line), line.points, false);
    return out_ + "0\nENDSEC\n0\nEOF\n";
  }

private:
  static std::string areaLayer(const DrawnArea& area) { return layerName("LAYER_" + area.layer); }
  static std::string lineLayer(const DrawnLine& line) { return layerName((line.is_fault ? "FAULT_" : "HORIZON_") + line.name); }

  void add(const std::string& layer, const std::vector<Eigen::Vector2d>& points, bool closed) {
    out_ += "0\nPOLYLINE\n8\n" + layer + "\n66\n1\n70\n" + (closed ? "1" : "0") + "\n";
    for (const Eigen::Vector2d& p : points)
      out_ += "0\nVERTEX\n8\n" + layer + "\n10\n" + number(p.x()) + "\n20\n" + number(z_factor_ * p.y()) + "\n30\n0\n";
    out_ += "0\nSEQEND\n";
  }

  const SectionDrawing& d_;
  double z_factor_;
  std::string out_;
};

Vector3 inSpace(const Eigen::Vector2d& p, const std::vector<Eigen::Vector2d>& plan) {
  double left = p.x();
  std::size_t i = 0;
  while (i + 2 < plan.size() && left > (plan[i + 1] - plan[i]).norm()) {
    left -= (plan[i + 1] - plan[i]).norm();
    ++i;
  }
  const Eigen::Vector2d xy = plan[i] + left * (plan[i + 1] - plan[i]).normalized();
  return {xy.x(), xy.y(), p.y()};
}

} // namespace

std::string sectionDxf(const SectionDrawing& drawing) { return DxfWriter(drawing).write(); }

std::string sectionVtp(const SectionDrawing& drawing, const std::vector<Eigen::Vector2d>& plan) {
  std::string points, line_cells, line_ends, ring_cells, ring_ends, layers;
  std::size_t count = 0, lines = 0, rings = 0;
  const auto add = [&](const std::vector<Eigen::Vector2d>& shape, std::string& cells, std::string& ends, std::size_t& used) {
    for (const Eigen::Vector2d& p : shape) {
      const Vector3 q = inSpace(p, plan);
      points += number(q.x()) + " " + number(q.y()) + " " + number(q.z()) + "\n";
      cells += std::to_string(count++) + " ";
    }
    used += shape.size();
    ends += std::to_string(used) + " ";
  };
  std::size_t line_points = 0, ring_points = 0;
  for (const DrawnLine& line : drawing.lines) {
    add(line.points, line_cells, line_ends, line_points);
    layers += "-1 ";
    ++lines;
  }
  for (const DrawnArea& area : drawing.areas)
    for (const auto& ring : area.rings) {
      add(ring, ring_cells, ring_ends, ring_points);
      layers += std::to_string(area.layer_number) + " ";
      ++rings;
    }
  const auto array = [](const std::string& type, const std::string& name, const std::string& content) {
    return "<DataArray type=\"" + type + "\" Name=\"" + name + "\" format=\"ascii\">\n" + content + "\n</DataArray>\n";
  };
  std::string out = "<?xml version=\"1.0\"?>\n<VTKFile type=\"PolyData\" version=\"1.0\" byte_order=\"LittleEndian\">\n<PolyData>\n";
  out += "<Piece NumberOfPoints=\"" + std::to_string(count) + "\" NumberOfLines=\"" + std::to_string(lines) + "\" NumberOfPolys=\"" +
         std::to_string(rings) + "\">\n<CellData>\n" + array("Int32", "layer", layers) + "</CellData>\n";
  out += "<Points>\n<DataArray type=\"Float64\" NumberOfComponents=\"3\" format=\"ascii\">\n" + points + "</DataArray>\n</Points>\n";
  out += "<Lines>\n" + array("Int64", "connectivity", line_cells) + array("Int64", "offsets", line_ends) + "</Lines>\n";
  out += "<Polys>\n" + array("Int64", "connectivity", ring_cells) + array("Int64", "offsets", ring_ends) + "</Polys>\n";
  return out + "</Piece>\n</PolyData>\n</VTKFile>\n";
}

} // namespace graben
