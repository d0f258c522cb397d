#include "graben/visualization/html_report.h"

#include "drawing/clipped_mesh.h"
#include "drawing/colors.h"
#include "drawing/thinned_mesh.h"
#include "html_parts.h"

#include "graben/core/atomic_file.h"
#include "graben/core/errors.h"
#include "graben/core/ticks.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>

namespace graben {

namespace {

using Json = nlohmann::ordered_json;

constexpr const char* kStage = "writing the report page";
constexpr double kReliefShare = 0.2;  // of the width: how high the relief is at first
constexpr double kPercentile = 0.98;  // of a field: where its colours end

std::string base64(const std::string& bytes) {
  static constexpr char kLetters[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    std::uint32_t three = 0;
    for (std::size_t k = 0; k < 3; ++k)
      three = three << 8 | (i + k < bytes.size() ? static_cast<unsigned char>(bytes[i + k]) : 0U);
    for (std::size_t k = 0; k < 4; ++k)
      text += i + k <= bytes.size() ? kLetters[three >> (18 - 6 * k) & 63] : '=';
  }
  return text;
}

template <typename T>
std::string encoded(const std::vector<T>& values) {
  return base64(std::string(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T)));
}

std::string placesOf(const Points& points, const Vector3& origin) {
  std::vector<float> places;
  places.reserve(3 * points.size());
  for (const Vector3& p : points)
    for (int k = 0; k < 3; ++k)
      places.push_back(static_cast<float>(p[k] - origin[k]));
  return encoded(places);
}

std::string cornersOf(const TriangleMesh& mesh) {
  std::vector<std::uint32_t> corners;
  for (const Triangle& t : mesh.triangles)
    for (const Index v : t)
      corners.push_back(static_cast<std::uint32_t>(v));
  return encoded(corners);
}

Json bytesOf(const Color& c) {
  Json rgb = Json::array();
  for (const double x : c)
    rgb.push_back(std::lround(255.0 * x));
  return rgb;
}

Json scaleOf(const ColorScale& scale) {
  Json stops = Json::array();
  for (int i = 0; i < 64; ++i)
    for (const auto& x : bytesOf(scale.at(i / 63.0)))
      stops.push_back(x);
  return stops;
}

/// From where to where a field's colours go.
std::array<double, 2> rangeOf(const ReportField& field, const std::vector<float>& values) {
  std::vector<double> finite;
  for (const float v : values)
    if (std::isfinite(v))
      finite.push_back(field.scale == ReportField::Scale::Signed ? std::abs(static_cast<double>(v)) : static_cast<double>(v));
  if (finite.empty())
    return {0.0, 1.0};
  if (field.scale == ReportField::Scale::Height)
    return {*std::min_element(finite.begin(), finite.end()), *std::max_element(finite.begin(), finite.end())};
  const auto at = finite.begin() + static_cast<std::ptrdiff_t>(kPercentile * static_cast<double>(finite.size() - 1));
  std::nth_element(finite.begin(), at, finite.end());
  const double high = *at > 0.0 ? *at : 1.0;
  return {field.scale == ReportField::Scale::Signed ? -high : 0.0, high};
}

class Page {
public:
  explicit Page(const HtmlReport& report) : report_(report) {
    if (report.mesh == nullptr || report.mesh->empty())
      throw InvalidInputError(kStage, "there is no surface");
    validate(*report.mesh, kStage);
    TriangleMesh mesh;
    mesh.vertices = report.mesh->vertices;
    mesh.triangles = report.mesh->triangles;
    mesh.piece = report.mesh->piece;
    for (const ReportField& field : report.fields) {
      if (field.values.size() != mesh.vertices.size())
        throw InvalidInputError(kStage, "the field " + field.name + " has not one value per vertex");
      mesh.scalars[field.name] = field.values;
    }
    mesh_ = thinnedMesh(mesh, report.most_triangles);
    box_ = boxAroundSurface(mesh_);
    origin_ = (0.5 * (box_.low + box_.high)).array().round();
  }

  std::string text() {
    std::string page = "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n<title>" + htmlText(report_.title) +
                       "</title>\n<style>\n" + html::kStyle + "</style>\n</head>\n<body>\n<h1>" + htmlText(report_.title) + "</h1>\n";
    if (!report_.sections.empty())
      page += report_.sections.front().html;
    const std::string data = this->data();
    page += "<h2>The surface</h2>\n<div id=\"controls\"></div>\n<div id=\"bar\"></div>\n<canvas id=\"view\"></canvas>\n"
            "<p id=\"readout\">Drag to turn, with shift to shift, wheel to zoom; a click gives coordinates and the throw of the nearest fault.</p>\n";
    for (const std::string& note : notes_)
      page += "<p>" + htmlText(note) + "</p>\n";
    for (std::size_t i = 1; i < report_.sections.size(); ++i)
      page += "<h2>" + htmlText(report_.sections[i].title) + "</h2>\n" + report_.sections[i].html;
    page += pictures();
    page += "<script type=\"application/json\" id=\"data\">" + data + "</script>\n<script>\n" + std::string(html::kViewer) + "</script>\n</body>\n</html>\n";
    return page;
  }

private:
  std::string data() {
    Json j;
    j["units"] = {{"xy", report_.units.xy}, {"z", report_.units.z}};
    j["down"] = report_.units.z_positive == ZPositive::Down;
    j["origin"] = {origin_.x(), origin_.y(), origin_.z()};
    const Vector3 size = box_.size();
    const double factor = size.z() > 0.0 ? kReliefShare * std::max(size.x(), size.y()) / size.z() : 1.0;
    j["exaggeration"] = factor > 1.0 ? roundDown125(std::min(factor, 300.0)) : 1.0;
    j["mesh"] = {{"positions", placesOf(mesh_.vertices, origin_)}, {"triangles", cornersOf(mesh_)}};
    j["fields"] = fields();
    j["faults"] = Json::array();
    for (const ReportFault& fault : report_.faults) {
      const TriangleMesh near = clippedMesh(*fault.mesh, box_);
      j["faults"].push_back({{"name", fault.name}, {"positions", placesOf(near.vertices, origin_)}, {"triangles", cornersOf(near)}});
    }
    j["picks"] = picks();
    j["throws"] = throws();
    j["scales"] = {{"height", scaleOf(ColorScale::height())}, {"deviation", scaleOf(ColorScale::deviation())}, {"signed", scaleOf(ColorScale::signedValue())}};
    j["pieces"] = Json::array();
    for (Index piece = 0; piece < 8; ++piece)
      for (const auto& x : bytesOf(pieceColor(piece)))
        j["pieces"].push_back(x);
    if (mesh_.triangles.size() < report_.mesh->triangles.size())
      notes_.push_back("The view shows " + std::to_string(mesh_.triangles.size()) + " of " + std::to_string(report_.mesh->triangles.size()) +
                       " triangles: the surface was thinned for it.");
    std::string text = j.dump(-1, ' ', false, Json::error_handler_t::replace);
    for (std::size_t at = 0; (at = text.find('<', at)) != std::string::npos;) // no name may end the script
      text.replace(at, 1, "\\u003c");
    return text;
  }

  Json fields() const {
    static constexpr const char* kScales[] = {"height", "deviation", "signed", "piece"};
    Json fields = Json::array();
    for (const ReportField& field : report_.fields) {
      const std::vector<float>& values = mesh_.scalars.at(field.name);
      const auto [low, high] = rangeOf(field, values);
      const int digits = std::clamp(2 - static_cast<int>(std::floor(std::log10(std::max(high - low, 1e-9)))), 0, 6);
      fields.push_back({{"name", field.name},
                        {"title", field.title},
                        {"unit", field.unit},
                        {"scale", kScales[static_cast<std::size_t>(field.scale)]},
                        {"low", low},
                        {"high", high},
                        {"digits", digits},
                        {"reversed", field.scale == ReportField::Scale::Height && report_.units.z_positive == ZPositive::Down},
                        {"values", encoded(values)}});
    }
    return fields;
  }

  Json picks() {
    std::size_t all = 0;
    for (const ReportPicks& set : report_.picks)
      all += set.points.size();
    const std::size_t every = std::max<std::size_t>(1, (all + report_.most_picks - 1) / std::max<std::size_t>(report_.most_picks, 1));
    if (every > 1)
      notes_.push_back("The view shows every " + std::to_string(every) + "th of " + std::to_string(all) + " picks.");
    Json sets = Json::array();
    for (const ReportPicks& set : report_.picks) {
      Points some;
      for (std::size_t i = 0; i < set.points.size(); i += every)
        some.push_back(set.points[i]);
      sets.push_back({{"name", set.name}, {"color", set.color}, {"positions", placesOf(some, origin_)}});
    }
    return sets;
  }

  Json throws() const {
    Json faults = Json::array();
    for (const ReportThrows& fault : report_.throws) {
      Json rows = Json::array();
      for (const ReportThrows::Row& r : fault.rows)
        rows.push_back({r.x, r.y, r.throw_, std::isfinite(r.deviation) ? Json(r.deviation) : Json()});
      faults.push_back({{"name", fault.fault}, {"rows", rows}});
    }
    return faults;
  }

  std::string pictures() const {
    if (report_.pictures.empty())
      return {};
    std::string html = "<h2>Pictures</h2>\n<div class=\"pictures\">\n";
    for (const ReportPicture& picture : report_.pictures) {
      std::ifstream file(picture.file, std::ios::binary);
      const std::string bytes((std::istreambuf_iterator<char>(file)), std::istreambuf_iterator<char>());
      if (!file || bytes.empty())
        throw IoError(picture.file, "the picture cannot be read");
      html += "<h3>" + htmlText(picture.title) + "</h3>\n<img alt=\"" + htmlText(picture.title) + "\" src=\"data:image/png;base64," + base64(bytes) + "\">\n";
    }
    return html + "</div>\n";
  }

  const HtmlReport& report_;
  TriangleMesh mesh_;
  Bounds box_;
  Vector3 origin_;
  std::vector<std::string> notes_;
};

} // namespace

void writeHtmlReport(const std::string& path, const HtmlReport& report) { writeFile(path, Page(report).text()); }

std::string htmlText(const std::string& text) {
  std::string html;
  for (const char c : text)
    switch (c) {
    case '&':
      html += "&amp;";
      break;
    case '<':
      html += "&lt;";
      break;
    case '>':
      html += "&gt;";
      break;
    case '"':
      html += "&quot;";
      break;
    default:
      html += c;
    }
  return html;
}

} // namespace graben
