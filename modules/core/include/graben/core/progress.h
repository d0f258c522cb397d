#pragma once

#include "graben/core/export.h"

#include <functional>
#include <string>

GRABEN_EXPORT_BEGIN
namespace graben {

/// What a long job is doing: the name of its stage and how much of that stage is done, 0 to 1.
struct Progress {
  std::string stage;
  double fraction = 0.0;
};

/// Called from the thread that started the job. May throw to stop the job; the exception reaches the caller.
using ProgressCallback = std::function<void(const Progress&)>;

/// Calls \a callback if there is one.
void report(const ProgressCallback& callback, const std::string& stage, double fraction);

} // namespace graben
GRABEN_EXPORT_END
