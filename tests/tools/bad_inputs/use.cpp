// Options out of range, configuration files, dips, and outputs that cannot be written.
#include "bad_input.h"

namespace graben::test {
namespace {

BadInput option(const std::string& name, const std::string& arguments, const std::string& says, int code = 2) { return {name, {}, arguments, code, says}; }

BadInput config(const std::string& name, const std::string& content, const std::string& says, int code = 2) {
  return {name, {{"job.conf", content}}, "--config job.conf", code, says};
}

BadInput dips(const std::string& name, const std::string& content, const std::string& says, int code = 1) {
  return {name, {{"dips.csv", content}}, "--dips dips.csv", code, says};
}

std::vector<BadInput> badOptions() {
  return {
      option("option_unknown", "--voxelsize 3", "unknown option --voxelsize; did you mean --voxel-size?"),
      option("option_short", "-v", "options start with two dashes"),
      option("option_without_value", "--rho", "option --rho needs a value"),
      option("option_twice", "--rho 1 --rho 2", "option --rho is given twice"),
      option("option_empty", "--rho ''", "option --rho has an empty value"),
      option("option_word_for_number", "--rho wide", "option --rho: 'wide' is not a number"),
      option("option_decimal_comma", "--rho 1,5", "option --rho: '1,5' is not a number"),
      option("option_nan", "--delta nan", "option --delta: 'nan' is not a number"),
      option("option_infinite", "--voxel-size inf", "option --voxel-size: 'inf' is not a number"),
      option("option_too_large_for_double", "--rho 1e400", "option --rho: '1e400' is not a number"),
      option("option_negative", "--zone-width=-1", "option --zone-width: '-1' is not between 0"),
      option("option_half_a_neighbour", "--neighbors 3.5", "option --neighbors: '3.5' is not a whole number"),
      option("option_two_neighbours", "--neighbors 2", "option --neighbors: '2' is not between 3"),
      option("option_flip_angle_beyond", "--flip-angle 181", "option --flip-angle: '181' is not between 0 and 180"),
      option("option_z_scale_zero", "--z-scale 0", "option --z-scale: '0' is not between"),
      option("option_choice", "--fit best", "option --fit: 'best' is not one of full, normal, off"),
      option("option_fault_dip", "--fault-dip 95", "option --fault-dip: '95' is not DEG,AZIMUTH"),
      option("option_threads", "--threads 1e9", "option --threads: '1e9' is not between 0 and 4096"),
      option("option_unit", "--xy-unit 'm<b>'", "option --xy-unit: 'm<b>' is no name of a unit"),
      option("option_skip", "--skip everything", "option --skip: 'everything' is not one of"),
      option("option_require", "--require 'rmse<5'", "the report has no figure 'rmse'"),
      option("option_word_too_many", "picks.xyz --", "belongs to no option"),
      option("option_columns_of_two", "--columns X,Y", "does not name three columns"),
      option("option_null_word", "--null void", "option --null: 'void' is not a number"),
      option("voxel_size_too_small", "--voxel-size 1e-6", "voxel", 1),
      option("voxel_size_too_large", "--voxel-size 1e9", "voxel size", 1),
      option("rho_too_large", "--rho 1e12", "rho", 1),
      option("delta_too_large", "--delta 1e12", "delta", 1),
      option("rho_too_small", "--rho 1e-9", "rho", 1),
      option("clearance_beyond_all_picks", "--clearance 1e6", "400 of 400 picks were set aside, 400 of them within the clearance", 1),
      option("memory_too_small", "--memory-limit 1e-5", "raise the limit", 1),
  };
}

std::vector<BadInput> badConfigurations() {
  return {
      config("config_number", "# job\n\nrho = soon\n", "job.conf:3: option --rho: 'soon' is not a number"),
      config("config_range", "neighbors = 15\nflip-angle = 400\n", "job.conf:2: option --flip-angle: '400' is not between 0 and 180"),
      config("config_choice", "fit = best\n", "job.conf:1: option --fit: 'best' is not one of full, normal, off"),
      config("config_key", "rhoo = 3\n", "job.conf:1: unknown option --rhoo; did you mean --rho?"),
      config("config_after_a_byte_order_mark", "\xEF\xBB\xBFrho = 3\r\nfit = best\r\n", "job.conf:2: option --fit: 'best'"),
      config("config_without_equals", "rho 3\n", "job.conf:1: expected 'key = value'"),
      config("config_twice", "rho = 3\nrho = 4\n", "job.conf:2: option --rho is given twice"),
      config("config_flag", "quiet = maybe\n", "job.conf:1: 'quiet' takes yes or no, not 'maybe'"),
      config("config_in_config", "config = other.conf\n", "job.conf:1: --config belongs on the command line"),
      config("config_in_utf16", std::string("\xFF\xFEr\0h\0o\0=\0001\0\n\0", 14), "job.conf: is in UTF-16"),
      config("config_long_line", std::string(10000000, 'x') + " = 1\n", "job.conf:1: unknown option --xxx"),
      option("config_missing", "--config none.conf", "none.conf: cannot open the configuration file", 1),
      option("config_folder", "--config .", "cannot read the configuration file", 1),
  };
}

std::vector<BadInput> badDips() {
  return {
      dips("dips_beyond_vertical", "x,y,z,dip,azimuth\n0,0,100,95,0\n", "dips.csv:2"),
      dips("dips_without_azimuth", "x,y,z,dip\n0,0,100,35\n", "dips.csv"),
      dips("dips_prose", "steep\n", "dips.csv"),
      dips("dips_one_far_away", "x,y,z,dip,azimuth\n50,50,100,1,0\n1e9,1e9,1e9,30,90\n", "1 of 2 dip measurements lie far from all picks", 0),
      dips("dips_all_far_away", "x,y,z,dip,azimuth\n1e9,1e9,1e9,30,90\n", "1 of 1 dip measurements lie far from all picks", 0),
  };
}

std::vector<BadInput> badPlaces() {
  return {
      option("horizon_missing", "--horizon none.xyz", "none.xyz: cannot be opened", 1),
      option("horizon_folder", "--horizon .", "is a folder, not a file", 1),
      option("fault_missing", "--fault none.pol", "none.pol: cannot be opened", 1),
      option("dips_missing", "--dips none.csv", "none.csv: cannot be opened", 1),
      option("output_extension", "--output top.xyzzy", "its extension must be one of .ply"),
      option("output_without_extension", "--output top", "its extension must be one of .ply"),
      option("output_in_no_folder", "--output none/top.ply", "none/top.ply", 4),
      option("output_is_a_folder", "--output folder.ply", "folder.ply", 4),
      option("output_is_the_horizon", "--output ./picks.ply --horizon picks.ply", "is the same file as --horizon picks.ply"),
      option("output_is_the_report", "--output same.ply --report same.ply", "are the same file"),
      option("output_on_a_full_disk", "--output full.ply", "No space left on device", 4),
      option("output_on_a_full_disk_by_vtk", "--output full.vtk", "No space left on device", 4),
      option("results_is_a_file", "--results picks.ply", "picks.ply", 4),
      option("output_with_a_name_too_long", "--output " + std::string(300, 'n') + ".ply", "cannot be written", 4),
  };
}

} // namespace

std::vector<BadInput> badUse() {
  std::vector<BadInput> all;
  for (const auto& part : {badOptions(), badConfigurations(), badDips(), badPlaces()})
    all.insert(all.end(), part.begin(), part.end());
  return all;
}

} // namespace graben::test
