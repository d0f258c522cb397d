#include "graben/faults/fault_network.h"
#include "graben/io/fault_reader.h"

#include <pcl/console/print.h>

#include <iterator>

namespace graben {

namespace {

void warn(const std::vector<std::string>& sentences) {
  for (const std::string& sentence : sentences)
    PCL_WARN("[graben::FaultNetwork::fromFiles] %s\n", sentence.c_str());
}

} // namespace

std::shared_ptr<const FaultNetwork> FaultNetwork::fromFiles(const std::vector<std::string>& files, const LocalFrame& frame, double branch_reach) {
  std::vector<FaultSurface> surfaces;
  for (const std::string& file : files)
    for (const FaultInput& fault : readFaults(file)) {
      LoftedFaults made = faultSurfaces(fault, frame);
      warn(fault.notes);
      warn(fault.warnings);
      warn(made.notes);
      warn(made.warnings);
      std::move(made.faults.begin(), made.faults.end(), std::back_inserter(surfaces));
    }
  return std::make_shared<const FaultNetwork>(std::move(surfaces), branch_reach);
}

} // namespace graben
