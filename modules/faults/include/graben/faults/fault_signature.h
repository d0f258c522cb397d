#pragma once

#include "graben/core/export.h"
#include "graben/faults/fault_network.h"

#include <cstdint>

GRABEN_EXPORT_BEGIN
namespace graben {

/// Which faults lie between two points, as one number: 0 if none, otherwise an exclusive-or of one random-looking number per fault that the
/// segment crosses an odd number of times. Points on the same side of every fault have signature 0 whatever way a wavy fault bends between them.
std::uint64_t faultSignature(const FaultNetwork& faults, const Vector3& a, const Vector3& b);

/// The number of one fault in such a signature.
std::uint64_t signatureOf(std::size_t fault);

/// True if nothing hides \a b from \a a: no fault is crossed an odd number of times.
inline bool sameSide(const FaultNetwork& faults, const Vector3& a, const Vector3& b) {
  return faultSignature(faults, a, b) == 0;
}

} // namespace graben
GRABEN_EXPORT_END
