#include "bindings.h"
#include "convert.h"
#include "job.h"

#include "graben/pipeline/horizon_reconstruction.h"
#include "graben/pipeline/realizations.h"
#include "support/horizon_options.h"

namespace graben::python {
namespace {

/// What is told beside the command's options.
struct Wishes {
  bool deviation = true;
  bool keep_picks = false;
  std::size_t realizations = 0;
  std::vector<Points> polygon; ///< that the surface is to cover; empty: as the options say
};

Wishes wishesOf(const py::dict& d) {
  Wishes wishes{d["deviation"].cast<bool>(), d["keep_picks"].cast<bool>(), d["realizations"].cast<std::size_t>(), {}};
  for (const py::handle& ring : d["polygon"].cast<py::list>())
    wishes.polygon.push_back(pointsOf(ring.cast<Doubles>()));
  return wishes;
}

std::vector<DipMeasurement> dipsOf(const Doubles& places, const Doubles& normals) {
  const Points at = pointsOf(places), facing = pointsOf(normals);
  std::vector<DipMeasurement> dips;
  for (std::size_t i = 0; i < at.size(); ++i)
    dips.push_back({at[i], facing[i]});
  return dips;
}

/// As the command does it, but for the files. \param[out] notes what was done to the input, a sentence each
ReconstructionResult run(const OptionValues& values, HorizonInput input, const Wishes& wishes, const ProgressCallback& progress,
                         std::vector<std::string>& notes) {
  ReconstructionOptions options = reconstructionOptions(values, input.picks.z_positive);
  options.keep_picks = wishes.keep_picks || wishes.realizations > 0;
  options.deviation = wishes.deviation;
  options.progress = progress;
  if (!wishes.polygon.empty()) {
    options.extent = HorizonExtent::Polygon;
    options.polygon = wishes.polygon;
  }
  ReconstructionResult result = HorizonReconstruction(options).reconstruct(std::move(input.picks.points), input.faults, input.dips);
  if (wishes.realizations > 0) {
    RealizationOptions again;
    again.job = options;
    again.count = wishes.realizations;
    realizeThrows(result, input.faults, input.dips, again);
  }
  std::vector<std::string>& warnings = result.report.warnings;
  warnings.insert(warnings.begin(), input.warnings.begin(), input.warnings.end());
  notes = std::move(input.notes);
  notes.insert(notes.end(), result.report.notes.begin(), result.report.notes.end());
  return result;
}

py::list cutoffsOf(ReconstructionResult& result) {
  py::list list;
  for (CutoffLine& line : result.cutoffs)
    list.append(py::make_tuple(line.fault, line.piece, line.side, handOver<Index>(std::move(line.vertices), 0), arrayOf(std::move(line.points))));
  return list;
}

void append(std::vector<double>& row, const Vector3& p) { row.insert(row.end(), {p.x(), p.y(), p.z()}); }

/// A table of numbers for each fault; the columns are those of graben.horizon.THROW_TYPE.
py::list throwsOf(const ReconstructionResult& result) {
  constexpr std::size_t kColumns = 12;
  py::list list;
  for (const std::vector<ThrowSample>& samples : result.throws) {
    std::vector<double> table;
    table.reserve(samples.size() * kColumns);
    for (const ThrowSample& s : samples) {
      append(table, s.footwall);
      append(table, s.hanging_wall);
      table.insert(table.end(), {s.along, s.throw_, s.heave, s.dip_slip, s.deviation, static_cast<double>(s.mark)});
    }
    list.append(handOver<double>(std::move(table), 0).attr("reshape")(samples.size(), kColumns));
  }
  return list;
}

/// Likewise; graben.horizon.PROFILE_TYPE.
py::list profilesOf(const ReconstructionResult& result) {
  constexpr std::size_t kColumns = 16;
  py::list list;
  for (const FaultProfile& profile : result.profiles) {
    std::vector<double> table;
    table.reserve(profile.rows.size() * kColumns);
    for (const ProfileRow& r : profile.rows) {
      append(table, r.footwall);
      append(table, r.hanging_wall);
      table.insert(table.end(), {r.along, r.throw_, r.heave, r.dip_slip, r.deviation, r.realized_low, r.realized_high, r.realized_deviation, r.dip, r.azimuth});
    }
    list.append(handOver<double>(std::move(table), 0).attr("reshape")(profile.rows.size(), kColumns));
  }
  return list;
}

py::list polygonsOf(ReconstructionResult& result) {
  py::list list;
  for (FaultPolygon& polygon : result.polygons)
    list.append(py::make_tuple(polygon.fault, polygon.overlap, polygon.area, arrayOf(std::move(polygon.ring))));
  return list;
}

py::object picksKept(ReconstructionResult& result) {
  if (result.picks.empty())
    return py::none();
  py::dict d;
  std::vector<std::uint8_t> reason;
  for (const PickReason r : result.pick_reason)
    reason.push_back(static_cast<std::uint8_t>(r));
  d["points"] = arrayOf(std::move(result.picks));
  d["normals"] = arrayOf(std::move(result.pick_normals));
  d["piece"] = handOver<Index>(std::move(result.pick_piece), 0);
  d["residual"] = handOver<float>(std::move(result.pick_residual), 0);
  d["reason"] = handOver<std::uint8_t>(std::move(reason), 0);
  return std::move(d);
}

py::dict dictOfResult(ReconstructionResult&& result) {
  py::dict d;
  py::list faults;
  for (FaultSurface& fault : result.faults) {
    py::dict mesh = dictOf(std::move(fault.mesh));
    mesh["name"] = fault.name;
    faults.append(mesh);
  }
  d["mesh"] = dictOf(std::move(result.mesh));
  d["vertex_faults"] = handOver<Index>(std::move(result.vertex_faults), 2);
  d["faults"] = faults;
  d["cutoffs"] = cutoffsOf(result);
  d["throws"] = throwsOf(result);
  d["profiles"] = profilesOf(result);
  d["polygons"] = polygonsOf(result);
  d["picks"] = picksKept(result);
  d["z_positive"] = wordOf(result.frame.z_positive);
  d["report"] = toJson(result.report);
  return d;
}

py::dict reconstruct(const std::vector<std::string>& words, const py::dict& picks, const py::list& faults, const py::tuple& dips, const py::dict& wishes,
                     const py::object& progress) {
  OptionParser parser("graben.reconstruct", "");
  declareHorizonOptions(parser);
  const OptionValues values = parser.parse(words);
  const Wishes wished = wishesOf(wishes);
  PickSet pick_set = picksOf(picks);
  std::vector<FaultInput> fault_inputs = faultsOf(faults);
  std::vector<DipMeasurement> measured = dipsOf(dips[0].cast<Doubles>(), dips[1].cast<Doubles>());
  ReconstructionResult result;
  std::vector<std::string> notes;
  runJob(progress, [&](const ProgressCallback& callback) {
    HorizonInput input = joinHorizonInput(values, std::move(pick_set), std::move(fault_inputs));
    input.dips = std::move(measured);
    result = run(values, std::move(input), wished, callback, notes);
  });
  py::dict d = dictOfResult(std::move(result));
  d["notes"] = notes;
  return d;
}

} // namespace

void bindHorizon(py::module_& m) {
  m.def("reconstruct", &reconstruct, py::arg("words"), py::arg("picks"), py::arg("faults"), py::arg("dips"), py::arg("wishes"), py::arg("progress"));
}

} // namespace graben::python
