#include "graben/core/interruption.h"

namespace graben {
namespace {

thread_local const std::atomic<bool>* innermost = nullptr;

} // namespace

InterruptionScope::InterruptionScope(const std::atomic<bool>& asked) : outer_(innermost) { innermost = &asked; }

InterruptionScope::~InterruptionScope() { innermost = outer_; }

const std::atomic<bool>* InterruptionScope::current() { return innermost; }

} // namespace graben
