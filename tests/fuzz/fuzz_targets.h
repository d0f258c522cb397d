#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace graben::test {

/// Something that takes any bytes: gives a result or throws an Error, and never crashes, hangs or takes memory by a header's word.
struct FuzzTarget {
  std::string name; ///< also of its folder in corpus/
  /// \throw std::logic_error if what comes out breaks its own promises
  void (*run)(const std::uint8_t* bytes, std::size_t size);
  std::size_t longest; ///< bytes; longer input finds nothing new and is slow
};

const std::vector<FuzzTarget>& readerTargets();
const std::vector<FuzzTarget>& geometryTargets();

/// \throw std::invalid_argument that lists the names if there is none called \a name
const FuzzTarget& fuzzTarget(const std::vector<FuzzTarget>& targets, const std::string& name);

/// Throws std::logic_error with \a promise unless it is kept.
void require(bool kept, const char* promise);

} // namespace graben::test
