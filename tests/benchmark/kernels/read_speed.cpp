// Reads picks, as graben_reconstruct does, and says how long it took.
#include "graben/io/pick_reader.h"

#include <chrono>
#include <cstdio>
#include <exception>

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fprintf(stderr, "Usage: %s PICKS\n", argv[0]);
    return 2;
  }
  try {
    const auto start = std::chrono::steady_clock::now();
    const std::size_t picks = graben::readPicks(argv[1]).points.size();
    const std::chrono::duration<double> time = std::chrono::steady_clock::now() - start;
    std::printf("picks %zu\ntime read %.6f\n", picks, time.count());
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
  return 0;
}
