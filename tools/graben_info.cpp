#include "support/horizon_options.h"
#include "support/recognise.h"
#include "support/run.h"

#include "graben/core/errors.h"
#include "graben/core/local_frame.h"
#include "graben/features/mean_distance.h"
#include "graben/features/pick_layout.h"
#include "graben/features/sampling.h"
#include "graben/io/input_check.h"
#include "graben/mesh/bounds.h"
#include "graben/mesh/components.h"

#include <cstdarg>
#include <cstdio>

namespace graben {
namespace {

OptionParser parser() {
  OptionParser p("graben_info",
                 "Says of files what they are, how they are laid out, what they hold, and what graben_reconstruct would take them for.");
  p.positionals("FILE...", "picks, fault sticks or surfaces; FILE:NAME for one of several horizons in a file", 1, 10000);
  p.section("Input").value("as", "WHAT", "what the files are: auto, picks, fault or surface", "auto");
  declareTableOptions(p);
  p.epilog("Example:\n  graben_info top.csv faults/*.pol\n");
  return p;
}

/// A line `  label     text`.
[[gnu::format(printf, 2, 3)]] void line(const char* label, const char* format, ...) {
  std::printf("  %-9s ", label);
  std::va_list arguments;
  va_start(arguments, format);
  std::vprintf(format, arguments);
  va_end(arguments);
  std::printf("\n");
}

void sayBox(const Bounds& box, const std::string& xy_unit, const std::string& z_unit) {
  const char* names[] = {"x", "y", "z"};
  for (int k = 0; k < 3; ++k)
    line(names[k], "%.10g to %.10g %s", box.low[k], box.high[k], (k < 2 ? xy_unit : z_unit).c_str());
}

const char* wayOf(ZPositive way) {
  return way == ZPositive::Down ? "down (depth or time)" : way == ZPositive::Up ? "up (elevation)" : "not said";
}

void sayWay(ZPositive way, const std::string& reason) {
  line("z grows", "%s%s%s", wayOf(way), reason.empty() ? "" : ": ", reason.c_str());
}

/// How the picks lie, in the frame that graben_reconstruct works in.
void saySampling(const PickSet& picks) {
  const LocalFrame frame = LocalFrame::around(picks.points, picks.z_positive, 1.0, 0);
  Points local;
  local.reserve(picks.points.size());
  for (const Vector3& p : picks.points)
    local.push_back(frame.toLocal(p));
  try {
    const NeighborGrid grid(local, 0.0, 0);
    const PickLayout layout = pickLayout(grid);
    const Sampling sampling = estimateSampling(grid);
    line("spacing", "%.4g (median distance of neighbours), rho %.4g, noise %.3g", sampling.spacing, sampling.rho, sampling.sigma);
    if (layout.along_lines)
      line("lie", "along lines: %.0f %% of the picks, one every %.4g, lines about %.4g apart", 100.0 * layout.share, layout.along,
           layout.line_distance);
    else
      line("lie", "densely in all directions");
    line("assumed", "voxel size about %.4g, z scale 1, z grows %s", meanPickDistance(grid), picks.z_positive == ZPositive::Down ? "down" : "up");
  } catch (const Error& error) {
    line("lie", "cannot be told: %s", error.what());
  }
}

void sayAll(const char* label, const std::vector<std::string>& sentences) {
  for (const std::string& sentence : sentences)
    line(label, "%s", sentence.c_str());
}

void say(PickSet picks) {
  line("is", "%s%s%s: picks of a horizon%s%s", picks.format.c_str(), picks.layout.empty() ? "" : ", ", picks.layout.c_str(),
       picks.horizon.empty() ? "" : " ", picks.horizon.c_str());
  line("holds", "%zu picks%s, %zu rows without data, %zu rejected", picks.points.size(), picks.normals.empty() ? "" : " with normals",
       picks.no_data_rows, picks.rejected_rows);
  for (const NullCount& null : picks.nulls)
    line("null", "z %.10g, %zu times", null.value, null.rows);
  const InputFindings found = checkInput(picks, {});
  sayBox(boundsOf(picks.points), picks.xy_unit, picks.z_unit);
  sayWay(picks.z_positive, picks.z_reason);
  saySampling(picks);
  sayAll("note", picks.notes);
  sayAll("note", found.notes);
  sayAll("warning", picks.warnings);
  sayAll("warning", found.warnings);
  if (!found.contradiction.empty())
    line("refused", "%s", found.contradiction.c_str());
}

void say(const FaultInput& fault) {
  Bounds box;
  if (const auto* mesh = std::get_if<TriangleMesh>(&fault.geometry)) {
    line("is", "%s %s", mesh->triangles.empty() ? "points without triangles:" : "a surface:", fault.name.c_str());
    line("holds", "%zu vertices, %zu triangles in %zu pieces", mesh->vertices.size(), mesh->triangles.size(),
         mesh->triangles.empty() ? 0 : connectedComponents(*mesh).triangle_count.size());
    for (const auto& scalar : mesh->scalars)
      line("property", "%s", scalar.first.c_str());
    box = boundsOf(mesh->vertices);
  } else {
    const auto& sticks = std::get<std::vector<FaultStick>>(fault.geometry);
    std::size_t nodes = 0;
    for (const FaultStick& stick : sticks) {
      nodes += stick.points.size();
      box.extend(boundsOf(stick.points));
    }
    line("is", "sticks of a fault: %s", fault.name.c_str());
    line("holds", "%zu sticks, %zu nodes", sticks.size(), nodes);
  }
  sayBox(box, "", "");
  sayWay(fault.z_positive, "");
  if (fault.z_positive == ZPositive::Unknown)
    line("assumed", "z grows as that of the picks");
  sayAll("note", fault.notes);
  sayAll("warning", fault.warnings);
}

int inform(const OptionValues& values) {
  const ReadOptions options = readOptions(values);
  const ContentKind kind = contentKind(values.choice("as", {"auto", "picks", "fault", "surface"}));
  int code = 0;
  for (const std::string& file : values.positionals()) {
    std::printf("%s\n", file.c_str());
    try {
      const Recognised found = recognise(splitPickSource(file), options, kind, true);
      for (const PickSet& picks : found.picks)
        say(picks);
      for (const FaultInput& fault : found.faults)
        say(fault);
    } catch (const Error& error) {
      std::fflush(stdout);
      std::fprintf(stderr, "graben_info: error: %s\n", error.what());
      code = kNotGood;
    }
  }
  return code;
}

} // namespace
} // namespace graben

int main(int argc, char** argv) {
  return graben::runTool(graben::parser(), argc, argv, graben::inform);
}
