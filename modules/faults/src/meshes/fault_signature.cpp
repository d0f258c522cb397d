#include "graben/faults/fault_signature.h"

namespace graben {

// splitmix64 (public domain, S. Vigna): spreads consecutive fault indices over 64 bits.
std::uint64_t signatureOf(std::size_t fault) {
  std::uint64_t x = fault + 0x9e3779b97f4a7c15ULL;
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9ULL;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebULL;
  return x ^ (x >> 31);
}

std::uint64_t faultSignature(const FaultNetwork& faults, const Vector3& a, const Vector3& b) {
  Bounds box;
  box.extend(a);
  box.extend(b);
  std::uint64_t signature = 0;
  faults.boxes().forEachIn(box, [&](std::size_t fault) {
    if (faults.separates(fault, a, b))
      signature ^= signatureOf(fault);
    return true;
  });
  return signature;
}

} // namespace graben
