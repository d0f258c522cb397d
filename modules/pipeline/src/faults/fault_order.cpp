#include "faults/fault_order.h"

#include <algorithm>
#include <numeric>

namespace graben {

namespace {

bool before(const FaultSurface& a, const FaultSurface& b) {
  const auto less = [](const Vector3& p, const Vector3& q) { return std::lexicographical_compare(p.data(), p.data() + 3, q.data(), q.data() + 3); };
  return std::lexicographical_compare(a.mesh.vertices.begin(), a.mesh.vertices.end(), b.mesh.vertices.begin(), b.mesh.vertices.end(), less);
}

template <typename Value>
void reorder(std::vector<Value>& of_faults, const std::vector<std::size_t>& place) {
  if (of_faults.size() != place.size())
    return;
  std::vector<Value> result(place.size());
  for (std::size_t k = 0; k < place.size(); ++k)
    result[place[k]] = std::move(of_faults[k]);
  of_faults = std::move(result);
}

template <typename Item>
void renumber(std::vector<Item>& items, const std::vector<std::size_t>& place) {
  for (Item& item : items)
    item.fault = static_cast<Index>(place[static_cast<std::size_t>(item.fault)]);
  std::stable_sort(items.begin(), items.end(), [](const Item& a, const Item& b) { return a.fault < b.fault; });
}

} // namespace

FaultOrder::FaultOrder(std::vector<FaultSurface>& faults) : given_(faults.size()) {
  std::iota(given_.begin(), given_.end(), std::size_t{0});
  std::stable_sort(given_.begin(), given_.end(), [&faults](std::size_t a, std::size_t b) { return before(faults[a], faults[b]); });
  std::vector<FaultSurface> ordered;
  for (const std::size_t place : given_)
    ordered.push_back(std::move(faults[place]));
  faults = std::move(ordered);
}

void FaultOrder::restore(ReconstructionResult& result) const {
  if (std::is_sorted(given_.begin(), given_.end()))
    return;
  reorder(result.faults, given_);
  reorder(result.throws, given_);
  reorder(result.profiles, given_);
  reorder(result.report.faults, given_);
  reorder(result.report.seal.faults, given_);
  renumber(result.cutoffs, given_);
  renumber(result.polygons, given_);
  for (auto& on : result.vertex_faults) {
    for (Index& fault : on)
      if (fault >= 0)
        fault = static_cast<Index>(given_[static_cast<std::size_t>(fault)]);
  }
}

} // namespace graben
