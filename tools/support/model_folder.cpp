#include "support/model_folder.h"

#include "graben/core/atomic_file.h"
#include "graben/core/errors.h"
#include "graben/io/mesh_writer.h"
#include "graben/io/sealed_writer.h"
#include "graben/io/table_writer.h"
#include "graben/mesh/bounds.h"
#include "graben/model/model_section.h"
#include "graben/visualization/render.h"
#include "support/model_diagrams.h"
#include "support/section_files.h"

#include <Eigen/Geometry>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <set>

namespace graben {

namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

/// Writes all that a model's folder holds.
class FolderWriter {
public:
  FolderWriter(const fs::path& folder, const ModelResult& result) : folder_(folder), result_(result), sealed_(result.sealed) {}

  /// \return sentences for the user
  std::vector<std::string> write() {
    writeHorizons();
    drawAllanDiagrams(folder_ / "faults", result_);
    if (result_.check.good()) {
      writeBlocks();
      writePatches();
      writeBlockTable();
      writePatchTable();
      writeContacts();
      drawPictures();
      writeGmsh(add("model.msh"), sealed_);
      writeModel3d(add("model.ml"), sealed_, named("model"));
      writeMultiblock(add("model.vtm"), sealed_);
    } else {
      writeDefects();
    }
    writeFile(add("report.json"), modelJson(result_));
    return notes_;
  }

private:
  /// A place for a file; where two objects' names make one file name, the second has a number.
  std::string add(const std::string& name) {
    fs::path path = folder_ / name;
    for (int i = 2; !taken_.insert(path.string()).second; ++i)
      path = (folder_ / name).replace_filename(fs::path(name).stem().string() + "_" + std::to_string(i) + fs::path(name).extension().string());
    std::error_code error;
    fs::create_directories(path.parent_path(), error);
    if (error)
      throw WriteError(path.parent_path().string(), "the folder cannot be made: " + error.message());
    return path.string();
  }

  MeshWriteOptions named(const std::string& name) const {
    MeshWriteOptions o;
    o.name = name;
    o.z_positive = result_.frame.z_positive;
    return o;
  }

  const std::string& faultName(std::size_t f) const { return result_.faults[f].name; }

  void writeHorizons() {
    for (const std::vector<ModelHorizonResult>* all : {&result_.horizons, &result_.bounding})
      for (const ModelHorizonResult& h : *all)
        writeMesh(add("horizons/" + fileNameOf(h.name) + "_reconstructed.ply"), h.mesh, named(h.name));
  }

  void writeBlocks() {
    for (std::size_t b = 0; b < sealed_.blocks.size(); ++b)
      writeMesh(add("blocks/" + fileNameOf(sealed_.blocks[b].name) + ".ply"), blockSurface(sealed_, static_cast<Index>(b)), named(sealed_.blocks[b].name));
  }

  void writePatches() {
    for (std::size_t s = 0; s < sealed_.surfaces.size(); ++s) {
      const SealedSurface& surface = sealed_.surfaces[s];
      if (surface.kind != SealedSurfaceKind::Horizon && surface.kind != SealedSurfaceKind::Fault)
        continue;
      const TriangleMesh mesh = patchesOf(sealed_, static_cast<Index>(s));
      if (mesh.empty())
        continue;
      const char* folder = surface.kind == SealedSurfaceKind::Horizon ? "horizons/" : "faults/";
      writeMesh(add(folder + fileNameOf(surface.name) + ".ply"), mesh, named(surface.name));
      writeMesh(add(folder + fileNameOf(surface.name) + ".ts"), mesh, named(surface.name));
    }
  }

  void writeBlockTable() {
    std::vector<double> number, volume, area, layer_number;
    std::vector<std::string> name, layer, sides, neighbors;
    std::vector<std::set<Index>> next(sealed_.blocks.size());
    for (const SealedPatch& patch : sealed_.patches)
      if (patch.in_front >= 0 && patch.in_front != patch.behind) {
        next[static_cast<std::size_t>(patch.behind)].insert(patch.in_front);
        next[static_cast<std::size_t>(patch.in_front)].insert(patch.behind);
      }
    for (std::size_t b = 0; b < sealed_.blocks.size(); ++b) {
      const SealedBlock& block = sealed_.blocks[b];
      number.push_back(static_cast<double>(b + 1));
      volume.push_back(block.volume);
      area.push_back(block.area);
      name.push_back(block.name);
      layer.push_back(layerName(block.layer));
      layer_number.push_back(block.layer);
      std::string side, list;
      for (std::size_t f = 0; f < block.fault_side.size(); ++f)
        if (block.fault_side[f] != 0)
          side += (side.empty() ? "" : " ") + faultName(f) + ":" +
                  (block.fault_side[f] == 2 ? "both" : block.fault_side[f] > 0 ? "hanging_wall" : "footwall");
      for (const Index other : next[b])
        list += (list.empty() ? "" : " ") + std::to_string(other + 1);
      sides.push_back(side);
      neighbors.push_back(list);
    }
    writeTable(add("blocks.csv"), {{"number", number}, {"name", name}, {"layer", layer}, {"layer_number", layer_number}, {"faults", sides},
                                   {"volume", volume}, {"area", area}, {"neighbours", neighbors}});
  }

  std::string layerName(Index layer) const {
    const auto& h = result_.horizons;
    if (layer == 0)
      return "above " + h.front().name;
    if (static_cast<std::size_t>(layer) == h.size())
      return "below " + h.back().name;
    return h[static_cast<std::size_t>(layer) - 1].name + " to " + h[static_cast<std::size_t>(layer)].name;
  }

  /// Blocks behind and in front of each patch by number; 0: outside.
  void writePatchTable() {
    const std::map<SealedSurfaceKind, std::string> kinds = {{SealedSurfaceKind::Wall, "wall"}, {SealedSurfaceKind::Top, "top"},
                                                            {SealedSurfaceKind::Base, "base"}, {SealedSurfaceKind::Horizon, "horizon"},
                                                            {SealedSurfaceKind::Fault, "fault"}};
    std::vector<double> number, behind, in_front;
    std::vector<std::string> surface, kind, way;
    for (std::size_t p = 0; p < sealed_.patches.size(); ++p) {
      const SealedPatch& patch = sealed_.patches[p];
      number.push_back(static_cast<double>(p + 1));
      surface.push_back(sealed_.surfaces[static_cast<std::size_t>(patch.surface)].name);
      kind.push_back(kinds.at(sealed_.surfaces[static_cast<std::size_t>(patch.surface)].kind));
      behind.push_back(patch.behind + 1.0);
      in_front.push_back(patch.in_front + 1.0);
      way.push_back(result_.frame.z_positive == ZPositive::Down ? "down" : "up");
    }
    writeTable(add("patches.csv"), {{"number", number}, {"surface", surface}, {"kind", kind}, {"behind", behind}, {"in_front", in_front},
                                    {"z_positive", way}});
  }

  /// Which layers face each other across each fault.
  void writeContacts() {
    std::map<std::array<Index, 3>, double> areas;
    for (std::size_t t = 0; t < sealed_.triangles.size(); ++t) {
      const SealedPatch& patch = sealed_.patchOf(t);
      if (sealed_.surfaces[static_cast<std::size_t>(patch.surface)].kind != SealedSurfaceKind::Fault)
        continue;
      const auto p = [&](std::size_t i) -> const Vector3& { return sealed_.vertices[static_cast<std::size_t>(sealed_.triangles[t][i])]; };
      const auto layer = [&](Index block) { return sealed_.blocks[static_cast<std::size_t>(block)].layer; };
      areas[{patch.surface, layer(patch.behind), layer(patch.in_front)}] += 0.5 * (p(1) - p(0)).cross(p(2) - p(0)).norm();
    }
    std::vector<std::string> fault, foot, hanging;
    std::vector<double> area;
    for (const auto& [key, value] : areas) {
      fault.push_back(sealed_.surfaces[static_cast<std::size_t>(key[0])].name);
      foot.push_back(layerName(key[1]));
      hanging.push_back(layerName(key[2]));
      area.push_back(value);
    }
    writeTable(add("contacts.csv"), {{"fault", fault}, {"footwall_layer", foot}, {"hanging_wall_layer", hanging}, {"area", area}});
  }

  /// Two sections through the middle, and the blocks drawn apart.
  void drawPictures() {
    SealedInput model;
    model.mesh = sealed_;
    model.z_positive = result_.frame.z_positive;
    for (const SealedBlock& block : sealed_.blocks)
      model.layer_names.push_back(layerName(block.layer));
    const Bounds box = boundsOf(sealed_.vertices);
    const Vector3 middle = 0.5 * (box.low + box.high);
    SectionFileOptions options;
    options.formats = {"png", "svg", "csv"};
    const auto section = [&](const std::string& name, const Eigen::Vector2d& from, const Eigen::Vector2d& to) {
      writeSection((folder_ / "sections").string(), name, model, cutModel(sealed_, {from, to}, model.z_positive == ZPositive::Down), options);
    };
    section("west_east", {box.low.x(), middle.y()}, {box.high.x(), middle.y()});
    section("south_north", {middle.x(), box.low.y()}, {middle.x(), box.high.y()});
    drawBlocksApart(box, middle);
  }

  /// Faces that look different ways do not share vertices: no shading runs round the block's edges.
  TriangleMesh sharpEdged(const TriangleMesh& block) const {
    TriangleMesh parts;
    std::map<std::pair<Index, Index>, Index> place;
    for (std::size_t i = 0; i < block.triangles.size(); ++i) {
      const auto p = [&](std::size_t k) -> const Vector3& { return block.vertices[static_cast<std::size_t>(block.triangles[i][k])]; };
      Eigen::Index axis = 0;
      const Vector3 normal = (p(1) - p(0)).cross(p(2) - p(0));
      normal.cwiseAbs().maxCoeff(&axis);
      const auto way = static_cast<Index>(2 * axis + (normal[axis] > 0.0 ? 1 : 0));
      Triangle t{};
      for (std::size_t k = 0; k < 3; ++k) {
        const auto [found, is_new] = place.insert({{block.triangles[i][k], way}, static_cast<Index>(parts.vertices.size())});
        if (is_new)
          parts.vertices.push_back(p(k));
        t[k] = found->second;
      }
      parts.triangles.push_back(t);
    }
    return parts;
  }

  void drawBlocksApart(const Bounds& box, const Vector3& middle) {
    constexpr double kApart = 0.25;
    TriangleMesh apart;
    for (std::size_t b = 0; b < sealed_.blocks.size(); ++b) {
      TriangleMesh block = sharpEdged(blockSurface(sealed_, static_cast<Index>(b)));
      const Bounds its = boundsOf(block.vertices);
      Vector3 shift = kApart * (0.5 * (its.low + its.high) - middle);
      const double down = result_.frame.z_positive == ZPositive::Down ? 1.0 : -1.0;
      shift.z() = down * sealed_.blocks[b].layer * 0.5 * box.size().z();
      for (Vector3& p : block.vertices)
        p += shift;
      block.piece.assign(block.vertices.size(), sealed_.blocks[b].layer);
      append(apart, block);
    }
    const Offscreen screen;
    if (!screen.available()) {
      notes_.push_back("No picture of the blocks: " + screen.reason());
      return;
    }
    SurfaceScene scene;
    scene.mesh = &apart;
    RenderOptions o;
    o.view = View::oblique();
    o.color_by = ColorBy::Piece;
    o.z_positive = result_.frame.z_positive;
    o.title = "blocks drawn apart, by layer";
    for (std::size_t layer = 0; layer <= result_.horizons.size(); ++layer)
      o.piece_names.push_back(layerName(static_cast<Index>(layer)));
    renderSurface(screen, add("blocks.png"), scene, o);
  }

  void writeDefects() {
    TriangleMesh mesh;
    for (const SealedDefect& defect : result_.check.defects) {
      if (defect.triangle < 0)
        continue;
      Triangle t;
      for (std::size_t i = 0; i < 3; ++i) {
        t[i] = static_cast<Index>(mesh.vertices.size());
        mesh.vertices.push_back(sealed_.vertices[static_cast<std::size_t>(sealed_.triangles[static_cast<std::size_t>(defect.triangle)][i])]);
      }
      mesh.triangles.push_back(t);
    }
    if (!mesh.empty())
      writeMesh(add("defects.vtp"), mesh, named("defects"));
  }

  fs::path folder_;
  const ModelResult& result_;
  const SealedMesh& sealed_;
  std::set<std::string> taken_;
  std::vector<std::string> notes_;
};

} // namespace

const FileSetNames& modelSet() {
  static const FileSetNames names{
    "graben_model.manifest", "report.json",
    "{\n  \"complete\": false,\n  \"note\": \"the run was ended while it exchanged the files of this folder; run it again\"\n}\n"};
  return names;
}

std::string fileNameOf(const std::string& name) {
  std::string result = name;
  for (char& c : result)
    if (std::isalnum(static_cast<unsigned char>(c)) == 0 && c != '-' && c != '_' && c != '.' && c != '+')
      c = '_';
  return result.empty() ? "unnamed" : result;
}

std::string modelJson(const ModelResult& result) {
  Json json;
  const SealedMesh& sealed = result.sealed;
  json["complete"] = true;
  json["closed"] = result.check.good();
  json["blocks"] = sealed.blocks.size();
  json["triangles"] = sealed.triangles.size();
  json["volume"] = result.check.volume_of_box;
  json["sum_of_block_volumes"] = result.check.volume_of_blocks;
  json["z_positive"] = result.frame.z_positive == ZPositive::Down ? "down" : "up";
  if (result.used.outline)
    json["outline"] = *result.used.outline;
  json["top"] = result.used.top.value_or(0.0);
  json["base"] = result.used.base.value_or(0.0);
  json["size"] = result.used.size;
  json["min_thickness"] = result.used.min_thickness;
  json["horizons"] = Json::array();
  for (const ModelHorizonResult& h : result.horizons)
    json["horizons"].push_back({{"name", h.name},
                                {"picks", h.report.picks},
                                {"voxel_size", h.report.used.voxel_size},
                                {"sigma", h.report.sampling.sigma},
                                {"extrapolated_share", h.in_model.extrapolated_share},
                                {"extrapolated_farthest", h.in_model.farthest},
                                {"absent_share", h.in_model.absent_share},
                                {"crossing", h.in_model.crossing}});
  json["faults"] = Json::array();
  for (const FaultSurface& fault : result.faults)
    json["faults"].push_back(fault.name);
  json["defects"] = Json::array();
  for (const SealedDefect& defect : result.check.defects)
    json["defects"].push_back(defect.what);
  json["warnings"] = result.warnings;
  json["notes"] = result.notes;
  json["stages"] = Json::array();
  for (const StageTiming& stage : result.stages)
    json["stages"].push_back({{"stage", stage.stage}, {"seconds", stage.seconds}, {"peak_bytes", stage.peak_bytes}});
  return json.dump(2) + "\n";
}

std::vector<std::string> writeModelFolder(const std::string& folder, const ModelResult& result) {
  FileSet set(folder, modelSet());
  std::vector<std::string> notes;
  try {
    notes = FolderWriter(set.staging(), result).write();
  } catch (const IoError& error) {
    throw set.inPlace(error);
  }
  set.commit();
  return notes;
}

void writeModelFile(const std::string& path, const ModelResult& result) {
  const std::string extension = fs::path(path).extension().string();
  MeshWriteOptions options;
  options.name = fs::path(path).stem().string();
  options.z_positive = result.frame.z_positive;
  if (extension == ".msh")
    writeGmsh(path, result.sealed);
  else if (extension == ".ml")
    writeModel3d(path, result.sealed, options);
  else
    writeMultiblock(path, result.sealed);
}

} // namespace graben
