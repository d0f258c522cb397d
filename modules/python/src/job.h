#pragma once

#include "graben/core/progress.h"

#include <pybind11/pybind11.h>

#include <functional>

namespace graben::python {

/// Runs work beside the Python thread that asks for it, which meanwhile lets other Python threads run, calls \a progress and looks for Ctrl-C.
///
/// \param[in] progress a callable of (stage, fraction), or None; called in the asking thread. What it raises stops the work and is raised
/// \param[in] work     gets the callback to hand on to graben; no Python in it
/// Ctrl-C (in the main thread) stops the work at the end of the blocks under way and raises KeyboardInterrupt.
/// \throw what the work throws, or pybind11::error_already_set
void runJob(const pybind11::object& progress, const std::function<void(const ProgressCallback&)>& work);

} // namespace graben::python
