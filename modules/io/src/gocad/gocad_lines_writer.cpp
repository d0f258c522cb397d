// GOCAD VSet and PLine, and the table of sticks that goes with them.
#include "content/numbers.h"
#include "gocad/gocad_frame.h"

#include "graben/core/atomic_file.h"
#include "graben/io/pick_writer.h"
#include "graben/io/table_writer.h"

namespace graben {
namespace {

void appendVertex(std::string& text, std::int64_t id, const Vector3& p) {
  text += "VRTX ";
  appendNumber(text, id);
  for (const double coordinate : p) {
    text += ' ';
    appendNumber(text, coordinate);
  }
  text += '\n';
}

} // namespace

void writeVset(const std::string& path, const std::string& name, const Points& points, const GocadFrame& frame) {
  AtomicFile file(path);
  file.write(gocadHeader("VSet", name, frame));
  std::string text;
  for (std::size_t i = 0; i < points.size(); ++i) {
    appendVertex(text, static_cast<std::int64_t>(i) + 1, points[i]);
    if (text.size() > (1 << 20)) {
      file.write(text);
      text.clear();
    }
  }
  file.write(text + "END\n");
  file.commit();
}

void writePline(const std::string& path, const std::vector<NamedSticks>& faults, const GocadFrame& frame) {
  AtomicFile file(path);
  for (const NamedSticks& fault : faults) {
    std::string text = gocadHeader("PLine", fault.name, frame);
    std::int64_t id = 0;
    for (const FaultStick& stick : fault.sticks) {
      text += "ILINE\n";
      const std::int64_t first = id;
      for (const Vector3& p : stick.points)
        appendVertex(text, ++id, p);
      for (std::int64_t v = first + 1; v < id; ++v)
        text += "SEG " + std::to_string(v) + " " + std::to_string(v + 1) + "\n";
    }
    file.write(text + "END\n");
  }
  file.commit();
}

void writeStickTable(const std::string& path, const std::vector<NamedSticks>& faults, const std::string& z_name) {
  std::vector<double> x, y, z, sticks, nodes;
  std::vector<std::string> names;
  for (const NamedSticks& fault : faults)
    for (std::size_t s = 0; s < fault.sticks.size(); ++s)
      for (std::size_t n = 0; n < fault.sticks[s].points.size(); ++n) {
        const Vector3& p = fault.sticks[s].points[n];
        x.push_back(p.x());
        y.push_back(p.y());
        z.push_back(p.z());
        names.push_back(fault.name);
        sticks.push_back(static_cast<double>(s + 1));
        nodes.push_back(static_cast<double>(n + 1));
      }
  writeTable(path, {{"X", x}, {"Y", y}, {z_name, z}, {"name", names}, {"stick", sticks}, {"node", nodes}});
}

} // namespace graben
