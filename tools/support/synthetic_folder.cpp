#include "support/synthetic_folder.h"

#include "support/file_arguments.h"

#include "graben/core/atomic_file.h"
#include "graben/core/file_set.h"
#include "graben/core/threads.h"
#include "graben/io/mesh_writer.h"
#include "graben/io/pick_writer.h"

#include <charconv>
#include <cmath>
#include <cstdint>
#include <filesystem>

namespace graben {
namespace {

namespace fs = std::filesystem;

std::string shown(double value) {
  char buffer[32];
  const auto end = std::to_chars(buffer, buffer + sizeof(buffer), value);
  return std::string(buffer, end.ptr);
}

std::string pcdHeader(std::size_t count) {
  const std::string n = std::to_string(count);
  return "# .PCD v0.7 - Point Cloud Data file format\nVERSION 0.7\nFIELDS x y z label\nSIZE 8 8 8 "
         "4\nTYPE F F F U\n"
         "COUNT 1 1 1 1\nWIDTH " +
         n + "\nHEIGHT 1\nVIEWPOINT 0 0 0 1 0 0 0\nPOINTS " + n + "\nDATA binary\n";
}

std::string plyHeader(std::size_t count) {
  return "ply\nformat binary_little_endian 1.0\nelement vertex " + std::to_string(count) +
         "\nproperty double x\nproperty double y\nproperty double z\nproperty uint "
         "label\nend_header\n";
}

/// Rows of x y z as double and the block as a 32 bit label.
void writeBinaryPicks(const std::string& path, const std::string& header,
                      const SyntheticPicks& picks) {
  AtomicFile file(path);
  file.write(header);
  for (std::size_t i = 0; i < picks.points.size(); ++i) {
    for (int axis = 0; axis < 3; ++axis)
      file.writeRaw(picks.points[i][axis]);
    file.writeRaw(static_cast<std::uint32_t>(picks.block[i]));
  }
  file.commit();
}

const FileSetNames& setNames() {
  static const FileSetNames names{"graben_synthesize.manifest", "synthetic.json", "{\n  \"complete\": false\n}\n"};
  return names;
}

class FolderWriter {
public:
  FolderWriter(const SyntheticModel& model, const std::string& folder,
               const SyntheticFolderOptions& options)
      : model_(model)
      , o_(model.options())
      , set_(folder, setNames())
      , options_(options) {}

  SyntheticFolder write() {
    try {
      writePicks();
      writeFaults();
      if (options_.truth)
        writeTruth();
      writeReadme();
      writeJson();
    } catch (const IoError& error) {
      throw set_.inPlace(error);
    }
    set_.commit();
    return {picks_, files_};
  }

private:
  std::string add(const std::string& name) {
    files_.push_back(name);
    return (fs::path(set_.staging()) / name).string();
  }

  void writePicks() {
    picks_ = writePicks(model_, "horizon");
    for (std::size_t k = 0; k < options_.deeper.size(); ++k)
      picks_ += writePicks(options_.deeper[k], "horizon_" + std::to_string(k + 2));
  }

  std::size_t writePicks(const SyntheticModel& model, const std::string& name) {
    SyntheticPicks picks = model.picks(options_.threads);
    const std::string path = add(name + "." + options_.format);
    if (options_.format == "pcd")
      writeBinaryPicks(path, pcdHeader(picks.points.size()), picks);
    else if (options_.format == "ply")
      writeBinaryPicks(path, plyHeader(picks.points.size()), picks);
    else {
      const double unit = std::pow(10.0, options_.decimals);
      parallelFor(picks.points.size(), 65536, options_.threads, [&](std::size_t i) {
        picks.points[i] = (picks.points[i] * unit).array().round() / unit;
      });
      writeXyz(path, picks.points);
    }
    return picks.points.size();
  }

  MeshWriteOptions named(const std::string& name) const {
    MeshWriteOptions write;
    write.name = name;
    write.z_positive = o_.frame.z_positive == ZPositive::Down ? ZPositive::Down : ZPositive::Up;
    write.z_unit = o_.z_unit;
    return write;
  }

  void writeFaults() {
    for (std::size_t i = 0; i < model_.faultCount(); ++i) {
      const std::string name = "fault_" + std::to_string(i + 1);
      writeMesh(add(name + ".ts"), model_.faultMesh(i), named(name));
      writePol(add(name + ".pol"), model_.faultSticks(i));
    }
  }

  void writeTruth() {
    const std::vector<TriangleMesh> blocks = model_.truthMeshes(options_.truth_resolution);
    TriangleMesh whole;
    for (std::size_t i = 0; i < blocks.size(); ++i) {
      const std::string name = "truth_block_" + std::to_string(i + 1);
      writeMesh(add(name + ".ts"), blocks[i], named(name));
      append(whole, blocks[i]);
    }
    writeMesh(add("truth.ply"), whole, named("truth"));
    for (std::size_t k = 0; k < options_.deeper.size(); ++k) {
      const std::string name = "truth_horizon_" + std::to_string(k + 2);
      TriangleMesh deeper;
      for (const TriangleMesh& block : options_.deeper[k].truthMeshes(options_.truth_resolution))
        append(deeper, block);
      writeMesh(add(name + ".ply"), deeper, named(name));
    }
    const std::vector<TrueCutoffLine> lines = model_.cutoffLines(options_.truth_resolution);
    for (std::size_t i = 0; i < model_.faultCount(); ++i)
      for (const int side : {-1, 1}) {
        std::vector<FaultStick> parts;
        for (const TrueCutoffLine& line : lines)
          if (line.fault == static_cast<Index>(i) && line.side == side)
            parts.push_back({line.points});
        const std::string wall = side < 0 ? "footwall" : "hangingwall";
        writePol(add("cutoff_fault_" + std::to_string(i + 1) + "_" + wall + ".pol"), parts);
      }
  }

  std::string command(const std::string& fault_extension) const {
    std::string text = "graben_reconstruct --horizon horizon." + options_.format;
    for (std::size_t i = 0; i < model_.faultCount(); ++i)
      text += (i == 0 ? " --fault fault_" : " fault_") + std::to_string(i + 1) + fault_extension;
    if (o_.frame.z_positive == ZPositive::Down)
      text += " --z-positive down";
    if (o_.frame.z_scale != 1.0)
      text += " --z-scale " + shown(o_.frame.z_scale);
    return text + " --output surface.ply --results results";
  }

  void writeReadme() {
    std::string text =
        "A synthetic faulted horizon with its exact truth, made by graben_synthesize.\n"
        "Kind " +
        kind() + ", " + std::to_string(picks_) + " picks, " + sampling() + ", spacing about " +
        shown(std::round(10.0 * o_.spacing()) / 10.0) + ", noise sigma " + shown(o_.noise) +
        " (vertical, x, y units), seed " + std::to_string(o_.seed) + ".\n\n" + "horizon." +
        options_.format + "  the picks\n";
    if (!options_.deeper.empty())
      text += "horizon_K." + options_.format + "  picks of the horizons below; with truth, truth_horizon_K.ply each of them as one mesh\n";
    if (model_.faultCount() > 0)
      text += "fault_N.ts, fault_N.pol  the faults as GOCAD surfaces and as sticks: the same "
              "surface twice, use one of them\n";
    if (options_.truth) {
      text += "truth_block_N.ts  the true horizon of each block, cut exactly at the faults\n"
              "truth.ply  all blocks in one mesh, with exact normals and the block as 'piece'\n";
      if (model_.faultCount() > 0)
        text +=
            "cutoff_fault_N_footwall.pol, cutoff_fault_N_hangingwall.pol  the true cutoff lines\n";
    }
    text += "synthetic.json  all options and files\n\nTo reconstruct it, in this folder:\n  " +
            command(".ts") + "\n";
    if (model_.faultCount() > 0)
      text += "or from the sticks:\n  " + command(".pol") + "\n";
    if (!options_.deeper.empty())
      text += "or all horizons as closed blocks:\n  " + modelCommand() + "\n";
    save("README.txt", text);
  }

  std::string modelCommand() const {
    std::string text = "graben_model --horizon H1=horizon." + options_.format;
    for (std::size_t k = 2; k <= options_.deeper.size() + 1; ++k)
      text += " H" + std::to_string(k) + "=horizon_" + std::to_string(k) + "." + options_.format;
    for (std::size_t i = 0; i < model_.faultCount(); ++i)
      text += (i == 0 ? " --fault fault_" : " fault_") + std::to_string(i + 1) + ".ts";
    if (o_.frame.z_positive == ZPositive::Down)
      text += " --z-positive down";
    if (o_.frame.z_scale != 1.0)
      text += " --z-scale " + shown(o_.frame.z_scale);
    return text + " --inset " + shown(std::round(0.05 * o_.size)) + " --results model";
  }

  std::string kind() const { return syntheticKindNames()[static_cast<std::size_t>(o_.kind)]; }

  std::string sampling() const { return syntheticSamplingNames()[static_cast<std::size_t>(o_.sampling.kind)]; }

  void writeJson() {
    const Vector3& origin = o_.frame.origin;
    std::string text = "{\n  \"kind\": \"" + kind() + "\",\n";
    const auto number = [&text](const std::string& name, double value) {
      text += "  \"" + name + "\": " + shown(value) + ",\n";
    };
    text += "  \"sampling\": \"" + sampling() + "\",\n  \"picks\": " + std::to_string(picks_) +
            ",\n  \"seed\": " + std::to_string(o_.seed) + ",\n";
    number("spacing", o_.spacing());
    number("size", o_.size);
    number("relief", o_.relief);
    number("tilt", o_.tilt);
    number("tilt_azimuth", o_.tilt_azimuth);
    number("noise", o_.noise);
    const SyntheticSampling& sampling = o_.sampling;
    number("line_distance", sampling.line_distance);
    number("cross_distance", sampling.cross_distance);
    number("along_line", sampling.along);
    number("azimuth", sampling.azimuth);
    number("contour_interval", sampling.contour_interval);
    number("shadow_footwall", sampling.shadow[0]);
    number("shadow_hanging_wall", sampling.shadow[1]);
    number("bridge", sampling.bridge);
    number("mistie", sampling.mistie);
    number("unpicked_share", sampling.unpicked_share);
    number("unpicked_length", sampling.unpicked_length);
    number("throw", o_.max_throw);
    number("throw_variation", o_.throw_variation);
    number("dip", o_.dip);
    number("uneven", o_.uneven);
    number("gap", o_.gap);
    number("smear", o_.smear);
    number("fault_distance", o_.fault_distance);
    number("waviness", o_.waviness);
    number("bend", o_.bend);
    number("overhang_above", o_.overhang_above);
    number("overhang_below", o_.overhang_below);
    number("strike_overhang", o_.strike_overhang);
    number("fault_mesh_size", o_.fault_mesh_size);
    number("fault_shift", o_.fault_shift);
    number("branch_gap", o_.branch_gap);
    number("stick_spacing", o_.stick_spacing);
    number("stick_jitter", o_.stick_jitter);
    text += "  \"stick_points\": " + std::to_string(o_.points_per_stick) + ",\n  \"holes\": [";
    for (std::size_t i = 0; i < o_.holes.size(); ++i)
      text += (i > 0 ? ", [" : "[") + disc(o_.holes[i]) + "]";
    text += "],\n  \"dense_patches\": [";
    for (std::size_t i = 0; i < o_.patches.size(); ++i)
      text += (i > 0 ? ", [" : "[") + disc(o_.patches[i].disc) + ", " +
              shown(o_.patches[i].factor) + "]";
    text += "],\n  \"origin\": [" + shown(origin.x()) + ", " + shown(origin.y()) + ", " +
            shown(origin.z()) + "],\n";
    text += std::string("  \"z_positive\": \"") + (o_.frame.mirrors() ? "down" : "up") + "\",\n";
    number("z_scale", o_.frame.z_scale);
    text += "  \"blocks\": " + std::to_string(model_.blockCount()) + ",\n  \"command\": \"" +
            command(".ts") + "\",\n";
    text += "  \"files\": [";
    for (std::size_t i = 0; i < files_.size(); ++i)
      text += (i > 0 ? ", \"" : "\"") + files_[i] + "\"";
    save("synthetic.json", text + "]\n}\n");
  }

  static std::string disc(const SyntheticDisc& d) {
    return shown(d.x) + ", " + shown(d.y) + ", " + shown(d.radius);
  }

  void save(const std::string& name, const std::string& text) {
    writeFile(add(name), text);
  }

  const SyntheticModel& model_;
  const SyntheticOptions& o_;
  FileSet set_;
  const SyntheticFolderOptions& options_;
  std::size_t picks_ = 0;
  std::vector<std::string> files_;
};

} // namespace

void checkSyntheticFolder(const OptionValues& values, std::size_t faults) {
  std::vector<std::string> names = {"horizon." + values.text("format"), "truth.ply", "README.txt", "synthetic.json", setNames().manifest};
  for (std::size_t i = 1; i <= faults; ++i)
    for (const char* extension : {".ts", ".pol"})
      names.push_back("fault_" + std::to_string(i) + extension);
  checkOutputFolder({"--output", values.text("output")}, setNames(), names, filesOf(values, {"config"}), {});
}

SyntheticFolder writeSyntheticFolder(const SyntheticModel& model, const std::string& folder, const SyntheticFolderOptions& options) {
  return FolderWriter(model, folder, options).write();
}

} // namespace graben
