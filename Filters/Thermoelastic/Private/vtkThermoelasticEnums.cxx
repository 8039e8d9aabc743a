// SPDX-License-Identifier: BSD-3-Clause
// The enums of the filter have the same numbers as the core's: values are cast between them.
#include "vtkThermoelasticFilter.h"

#include "Thermoelastic/LinearSolver.h"
#include "Thermoelastic/Material.h"
#include "Thermoelastic/Problem.h"
#include "Thermoelastic/StressRecovery.h"

namespace
{

// A number that differs is an error of the compiler, not a wrong result.
template <class Theirs>
constexpr bool Same(int mine, Theirs theirs)
{
  return mine == static_cast<int>(theirs);
}

using Filter = vtkThermoelasticFilter;
using meshopt::fem::PlaneState;
using meshopt::fem::RigidMotion;
using meshopt::fem::Solver;
using meshopt::fem::SolverStatus;
using meshopt::fem::StressRecovery;

static_assert(Same(Filter::PlaneStrain, PlaneState::PlaneStrain));
static_assert(Same(Filter::PlaneStress, PlaneState::PlaneStress));

static_assert(Same(Filter::Forbid, RigidMotion::Forbid));
static_assert(Same(Filter::Pin, RigidMotion::Pin));
static_assert(Same(Filter::Project, RigidMotion::Project));

static_assert(Same(Filter::Patch, StressRecovery::Patch));
static_assert(Same(Filter::LocalPatch, StressRecovery::LocalPatch));
static_assert(Same(Filter::VolumeAverage, StressRecovery::VolumeAverage));
static_assert(Same(Filter::None, StressRecovery::None));

static_assert(Same(Filter::ConjugateGradient, Solver::ConjugateGradient));
static_assert(Same(Filter::IncompleteCholesky, Solver::IncompleteCholesky));
static_assert(Same(Filter::Direct, Solver::Direct));

// NothingToDo is the filter's alone: the core is not called then.
static_assert(Same(Filter::NotRun, SolverStatus::NotRun));
static_assert(Same(Filter::Converged, SolverStatus::Converged));
static_assert(Same(Filter::IterationLimit, SolverStatus::IterationLimit));
static_assert(Same(Filter::Breakdown, SolverStatus::Breakdown));
static_assert(Same(Filter::Aborted, SolverStatus::Cancelled));

} // namespace
