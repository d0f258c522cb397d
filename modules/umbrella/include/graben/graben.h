#pragma once

/** \file
 * What a PCL program needs, in one include: the classes, faults, and the readers and writers of files. Link graben::umbrella.
 */

#include "graben/faults/fault_network.h"
#include "graben/features/fault_constrained_normal_estimation.h"
#include "graben/filters/fault_zone.h"
#include "graben/filters/wrong_side_filter.h"
#include "graben/io/fault_reader.h"
#include "graben/io/mesh_reader.h"
#include "graben/io/mesh_writer.h"
#include "graben/io/pick_reader.h"
#include "graben/mesh/conversions.h"
#include "graben/pipeline/faulted_horizon_reconstruction.h"
#include "graben/pipeline/model_reconstruction.h"
#include "graben/surface/fault_cutter.h"
#include "graben/surface/hoppe_marching_cubes.h"
#include "graben/surface/qem_fault_fitter.h"
