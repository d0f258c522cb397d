#pragma once

#include "picks/pick_formats.h"
#include "tables/text_layout.h"

namespace graben {

/// The columns of a header that hold x, y and z.
NamedColumns pointColumns(const std::vector<std::string>& names);

/// Decides which columns of a text table hold x, y and z, and says so in \a picks: those asked for, else those named in the header, else
/// those that the numbers tell.
/// \throw ParseError that asks for columns, if none are as asked or two readings are plausible
void settleColumns(TextLayout& layout, const PickFile& file, PickSet& picks);

/// The column that names the horizon of each row, if there is one and it names several: their names, in order of appearance.
struct HorizonColumn {
  int column = -1;
  std::vector<std::string> names;
};
HorizonColumn findHorizons(const TextLayout& layout, const TableSample& sample);

/// The text with empty lines for rows of other horizons.
std::string onlyHorizon(std::string_view body, const TextLayout& layout, int column, const std::string& name);

/// "holds several horizons: A, B; name one, FILE:NAME".
std::string severalHorizons(const std::vector<std::string>& names);

} // namespace graben
