#pragma once

#include "graben/model/model_section.h"

#include <map>

namespace graben {

/// Directed segments of one block's outline, the block to the left, that are joined to rings where ends have the same name.
class RingBuilder {
public:
  using Name = std::pair<Index, Index>; ///< the mesh edge a point lies on, or made up where the section ends

  void add(const Name& from, const SectionPoint2& a, const Name& to, const SectionPoint2& b);

  /// Joins what is open where two straight parts meet, or at the section's ends: ends at \a s one above the other are joined to starts.
  void close(std::vector<Name> ends, std::vector<Name> starts);

  std::vector<std::vector<SectionPoint2>> rings() const;

private:
  std::multimap<Name, Name> next_;
  std::map<Name, SectionPoint2> place_;
};

double ringArea(const std::vector<SectionPoint2>& ring);

} // namespace graben
