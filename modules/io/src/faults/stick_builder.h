#pragma once

#include "graben/io/fault_reader.h"

#include <cmath>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace graben {

/// Faults in the making out of rows: points are added to the stick they name, or to the last one until it is ended.
class StickBuilder {
public:
  explicit StickBuilder(std::string path)
      : path_(std::move(path)) {}

  /// \param[in] name of the fault; empty: the file's
  /// \param[in] stick which stick of the fault; empty: the one that is open
  /// \param[in] node where along the stick; not a number: behind the last
  void add(const std::string& name, std::string_view stick, double node, const Vector3& point);
  void end() { open_ = false; }
  bool isOpen() const { return open_; }

  /// Names that tell sticks and not faults (`F1_1`, `F1_2`, `stick 3`): where each has one stick only, and those are no traces on a map, they
  /// become sticks of one fault.
  void joinNumberedNames();

  /// A note for every fault of the file.
  void note(std::string text) { notes_.push_back(std::move(text)); }

  /// The faults in the order their names came in; null points and sticks of less than two points are dropped with a note.
  /// \throw ParseError if no stick is left
  std::vector<FaultInput> take();

private:
  struct Line {
    Points points;
    std::vector<double> nodes;
  };
  struct Fault {
    std::string name;
    std::vector<Line> lines;
    std::map<std::string, std::size_t, std::less<>> line_of_stick;
  };

  std::string path_;
  std::vector<Fault> faults_;
  std::map<std::string, std::size_t> fault_of_name_;
  std::size_t current_ = 0;
  bool open_ = false;
  std::vector<std::string> notes_;
};

} // namespace graben
