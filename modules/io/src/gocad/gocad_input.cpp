// What each use makes of the objects of a GOCAD file.
#include "content/file_content.h"
#include "faults/fault_formats.h"
#include "gocad/gocad_objects.h"
#include "meshes/mesh_formats.h"
#include "picks/pick_columns.h"
#include "picks/pick_formats.h"

#include "graben/core/errors.h"

#include <algorithm>
#include <cmath>

namespace graben {
namespace {

std::string typesOf(const std::vector<GocadObject>& objects) {
  std::string list;
  for (const GocadObject& object : objects)
    if (list.find(object.type) == std::string::npos)
      list += (list.empty() ? "" : ", ") + object.type;
  return list.empty() ? "no object" : list;
}

std::string nameOf(const GocadObject& object, const std::string& path) {
  return object.name.empty() ? stemOf(path) : object.name;
}

std::vector<std::string> notesOn(const GocadObject& object, bool properties_used = false) {
  std::vector<std::string> notes;
  if (object.has_other_properties || (!properties_used && !object.properties.empty()))
    notes.push_back("vertex properties ignored");
  return notes;
}

std::vector<std::string> warningsOn(const GocadObject& object, const std::string& path) {
  if (object.ended)
    return {};
  return {path + ": the object" + (object.name.empty() ? "" : " " + object.name) + " has no END; the file may be cut short"};
}

/// The property piece becomes the label, the others scalars.
void takeProperties(GocadObject& object, TriangleMesh& mesh) {
  for (GocadProperty& property : object.properties) {
    if (property.name != "piece") {
      mesh.scalars[property.name] = std::move(property.values);
      continue;
    }
    mesh.piece.clear();
    for (const float value : property.values)
      mesh.piece.push_back(std::abs(value) < 2e9F ? static_cast<Index>(value) : 0);
  }
}

/// Pieces where the surface has several TFACEs and none shares a vertex with another.
std::vector<Index> piecesOf(const GocadObject& object) {
  if (object.face_starts.size() < 2)
    return {};
  std::vector<Index> piece(object.vertices.size(), -1);
  Index face = -1;
  for (std::size_t t = 0; t < object.triangles.size(); ++t) {
    while (static_cast<std::size_t>(face + 1) < object.face_starts.size() &&
           object.face_starts[static_cast<std::size_t>(face + 1)] <= t)
      ++face;
    for (const Index v : object.triangles[t]) {
      Index& of_vertex = piece[static_cast<std::size_t>(v)];
      if (of_vertex >= 0 && of_vertex != face)
        return {};
      of_vertex = std::max<Index>(face, 0);
    }
  }
  for (Index& p : piece)
    p = std::max<Index>(p, 0);
  return piece;
}

TriangleMesh meshOf(GocadObject& object) {
  TriangleMesh mesh;
  mesh.piece = piecesOf(object);
  mesh.vertices = std::move(object.vertices);
  mesh.triangles = std::move(object.triangles);
  return mesh;
}

std::vector<FaultStick> sticksOf(const GocadObject& object, std::vector<std::string>& notes) {
  std::vector<Points> lines;
  for (const std::vector<Index>& line : object.lines) {
    Points& points = lines.emplace_back();
    for (const Index v : line)
      points.push_back(object.vertices[static_cast<std::size_t>(v)]);
  }
  return sticksFromLines(std::move(lines), notes);
}

} // namespace

std::vector<MeshInput> readGocadMeshes(std::string_view text, const std::string& path) {
  std::vector<GocadObject> objects = readGocadObjects(text, path);
  std::vector<MeshInput> meshes;
  for (GocadObject& object : objects)
    if (object.isSurface() && !object.triangles.empty()) {
      meshes.push_back({nameOf(object, path), meshOf(object), object.z_positive, notesOn(object, true), warningsOn(object, path)});
      takeProperties(object, meshes.back().mesh);
    }
  if (meshes.empty())
    throw ParseError(path, 0, "holds no TSurf with triangles (found: " + typesOf(objects) + ")");
  return meshes;
}

std::vector<FaultInput> readGocadFaults(std::string_view text, const std::string& path) {
  std::vector<GocadObject> objects = readGocadObjects(text, path);
  std::vector<FaultInput> faults;
  for (GocadObject& object : objects) {
    FaultInput fault{nameOf(object, path), {}, object.z_positive, path, notesOn(object, object.isSurface()), warningsOn(object, path)};
    if (object.isSurface() && !object.triangles.empty()) {
      TriangleMesh mesh = meshOf(object);
      takeProperties(object, mesh);
      fault.geometry = std::move(mesh);
    } else if (object.isLines()) {
      std::vector<FaultStick> sticks = sticksOf(object, fault.notes);
      if (sticks.empty())
        continue;
      fault.geometry = std::move(sticks);
    } else {
      continue;
    }
    faults.push_back(std::move(fault));
  }
  if (faults.empty())
    throw ParseError(path, 0,
                     "holds no fault: a TSurf with triangles or a PLine with sticks (found: " +
                         typesOf(objects) + ")");
  return faults;
}

PickSet readGocadPicks(std::string_view text, const PickFile& file) {
  const std::vector<GocadObject> objects = readGocadObjects(text, file.path);
  // A horizon may also be lines it was picked along, or a surface; its vertices are then the picks.
  const bool any_points = std::any_of(objects.begin(), objects.end(), [](const GocadObject& o) { return o.isPoints(); });
  const auto wanted = [&](const GocadObject& o) { return any_points ? o.isPoints() : (o.isLines() || o.isSurface()) && !o.vertices.empty(); };
  std::vector<std::string> names;
  for (const GocadObject& object : objects)
    if (wanted(object) && std::find(names.begin(), names.end(), object.name) == names.end())
      names.push_back(object.name);
  if (names.empty())
    throw ParseError(file.path, 0, "holds no VSet (found: " + typesOf(objects) + ")");
  if (file.options.horizon.empty() && names.size() > 1)
    throw SeveralHorizonsError(file.path, severalHorizons(names), names);
  if (!file.options.horizon.empty())
    requireHorizon(names, file);
  PickSet picks;
  picks.horizon = file.options.horizon.empty() ? names.front() : file.options.horizon;
  picks.layout = any_points ? "VSet" : "vertices of " + typesOf(objects);
  if (!any_points)
    picks.notes.push_back("no VSet: the vertices of " + typesOf(objects) + " taken as picks");
  bool first = true;
  for (const GocadObject& object : objects) {
    if (!wanted(object) || object.name != picks.horizon)
      continue;
    if (!first && object.z_positive != picks.z_positive)
      throw ParseError(file.path, object.line, "this object has another ZPOSITIVE than the one before; split the file");
    picks.z_positive = object.z_positive;
    picks.xy_unit = object.xy_unit;
    picks.z_unit = object.z_unit;
    first = false;
    picks.points.insert(picks.points.end(), object.vertices.begin(), object.vertices.end());
    for (std::string& note : notesOn(object))
      picks.notes.push_back(std::move(note));
    for (std::string& warning : warningsOn(object, file.path))
      picks.warnings.push_back(std::move(warning));
  }
  picks.z_reason = picks.z_positive == ZPositive::Unknown ? "" : "ZPOSITIVE in the file";
  return picks;
}

} // namespace graben
