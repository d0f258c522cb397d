#pragma once

#include "graben/io/fault_reader.h"

#include <string>
#include <string_view>
#include <vector>

namespace graben {

/// One reader per format; \a text is the whole file, \a path is for messages and default names.
std::vector<FaultInput> readGocadFaults(std::string_view text, const std::string& path);
std::vector<FaultInput> readCharismaFaults(std::string_view text, const std::string& path);
std::vector<FaultInput> readLineFaults(std::string_view text, const std::string& path);
std::vector<FaultInput> readCps3Faults(std::string_view text, const std::string& path);
std::vector<FaultInput> readIesxFaults(std::string_view text, const std::string& path);
std::vector<FaultInput> readBlnFaults(std::string_view text, const std::string& path);

/// True for lines of Surfer: a count, then so many rows x,y[,z].
bool isBln(std::string_view text);

/// Makes sticks of lines; null points and lines with fewer than two points are dropped with a note.
std::vector<FaultStick> sticksFromLines(std::vector<Points> lines, std::vector<std::string>& notes);

} // namespace graben
