#pragma once

#include <array>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace graben {

/// Reads the column names a text header gives, line by line.
///
/// Understood: a row of names (`X,Y,Z`, `# "X" "Y" "Inline" ...`, `//X Y Z`), OpendTect's `# 1: X` lines, EarthVision's `# Field: 1 x`,
/// a block BEGIN HEADER ... END HEADER with a name per line and RMS's `Float name` lines after x y z, Z-MAP+'s fields between lines
/// that begin with @, GSLIB's number of columns and a name per line, Tecplot's VARIABLES. The last row of names counts.
class HeaderNames {
public:
  void add(std::string_view line);

  /// The names; empty if there are none.
  std::vector<std::string> names() const;

  /// `Null_value: 1e30` of EarthVision and the like.
  const std::vector<double>& nulls() const { return nulls_; }

  /// `Unit in depth: m` of Petrel, `Units: meters` of EarthVision; empty if there are none.
  const std::string& xyUnit() const { return xy_unit_; }
  const std::string& zUnit() const { return z_unit_; }

  /// Lines of Petrel's or Z-MAP+'s block, whose numbers are no row of data.
  bool insideBlock() const { return inside_block_ || inside_fields_; }

private:
  bool addField(std::string_view line);
  void addNumbered(std::string_view text);
  void addListed(std::string_view text);
  void addFact(std::string_view text);

  std::map<std::size_t, std::string> numbered_;
  std::vector<std::string> row_, block_, attributes_, listed_;
  std::size_t listed_count_ = 0;
  std::vector<double> nulls_;
  std::string xy_unit_, z_unit_;
  bool inside_block_ = false;
  bool inside_fields_ = false;
};

/// Columns of x, y and z by name; -1 where no name fits.
std::array<int, 3> findCoordinateColumns(const std::vector<std::string>& names);

/// Another name that fits z as well as the one that findCoordinateColumns finds; empty if there is none.
std::string otherNameForZ(const std::vector<std::string>& names);

/// What two columns are called alike of those that findCoordinateColumns finds; empty if none are.
std::string nameGivenTwice(const std::vector<std::string>& names);

/// Columns of the dip, its azimuth (direction of dip) and the strike by name; -1 where no name fits.
struct DipColumns {
  int dip = -1;
  int azimuth = -1;
  int strike = -1;
};
DipColumns findDipColumns(const std::vector<std::string>& names);

/// What a column may be beside a coordinate.
enum class ColumnRole { Inline, Crossline, Longitude, Latitude, Horizon, Fault, Stick, Node };

/// The first column whose name says it has this role; -1 if there is none.
int findColumn(const std::vector<std::string>& names, ColumnRole role);

/// The column a user means by a name (as written, or but for case, blanks and units) or a number from 1; -1 if there is none.
int findColumn(const std::vector<std::string>& names, const std::string& wanted, std::size_t columns);

/// The unit a name ends with (`TVDSS_ft`, `Z [ms]`, `Depth (m)`): m, ft, km, ms, s; empty if there is none.
std::string unitOfName(const std::string& name);

/// A unit's usual spelling: "meters" gives m; empty for what is no unit of length or time.
std::string unitOf(std::string_view text);

/// Which way z of this name grows: 1 up, -1 down, 0 it does not say.
int senseOfName(const std::string& name);

} // namespace graben
