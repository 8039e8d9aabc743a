// SPDX-License-Identifier: BSD-3-Clause
// The stop reason in words for the user.
#include "Run/Report.h"

#include "Bound/SurfaceBound.h"

#include <cstdio>
#include <utility>

namespace meshopt
{
namespace
{
constexpr double HeldByBound = 0.9; ///< part of the bound from which on it is named as what holds

const char* toString(StopReason reason)
{
  // Without a default, so that the compiler names a reason that has no sentence.
  switch (reason)
  {
    case StopReason::TargetReached:
      return "target quality reached";
    case StopReason::CappedBySurface:
      return "capped by the surface: what is under the target cannot get better while it is kept";
    case StopReason::NoFurtherGain:
      return "no operation improves the worst cells any more";
    case StopReason::IterationLimit:
      return "limit of iterations reached";
    case StopReason::TimeLimit:
      return "time limit reached";
    case StopReason::Aborted:
      return "aborted";
    case StopReason::NothingToDo:
      return "nothing to do: no triangles or tetrahedra";
    case StopReason::GrowthLimit:
      return "growth budget used up: what would help needs more cells";
    case StopReason::NotRun:
      break;
  }
  return "not run";
}

/// If it is near: what bounds the worst cell of a run that has ended under its target.
std::string describeBound(const Report& report, const char* format)
{
  if (report.bound >= 1.0 || report.worstAfter <= HeldByBound * report.bound)
  {
    return {};
  }
  char held[96];
  std::snprintf(held, sizeof held, format, report.bound);
  return held;
}
}

/// The reason; and what holds the nodes of the worst cell, if the surface takes part.
std::string describeStop(const Report& report)
{
  std::string text = toString(report.stopReason);
  // At its bound no cells would help the worst one, whatever the others need.
  if (report.stopReason == StopReason::GrowthLimit && report.bound < 1.0 &&
    report.worstAfter >= CapReached * report.bound)
  {
    text = "growth budget used up, and the worst cell is as good as it can be";
  }
  const auto count = [&](Freedom freedom) { return report.worstNodes[static_cast<int>(freedom)]; };
  // From what moves least to what moves freely. Corners and fixed points are one kind to the
  // reader: neither slides.
  const std::pair<int, const char*> places[] = { { count(Freedom::Corner) + count(Freedom::Fixed),
                                                   "at corners" },
    { count(Freedom::Curve), "on curves" }, { count(Freedom::Patch), "on patches" },
    { count(Freedom::Free), "inside" } };
  std::string list;
  for (const auto& [number, place] : places)
  {
    // Kinds without a node of the worst cell are not named.
    list += number == 0 ? "" : (list.empty() ? "" : ", ") + std::to_string(number) + " " + place;
  }
  // Where the target is reached, nothing holds the worst cell.
  if (report.stopReason == StopReason::TargetReached)
  {
    return text;
  }
  // Without nodes the surface was kept. How far a run is from what it allows, its user wants to
  // know where nothing else says so.
  if (list.empty())
  {
    const bool isStuck = report.stopReason == StopReason::NoFurtherGain ||
      report.stopReason == StopReason::GrowthLimit;
    return text + (isStuck ? describeBound(report, "; what is kept allows no more than %.3g") : "");
  }
  // Only of a surface that stays the same set of points: with a tolerance no bound is known.
  return text + "; nodes of the worst one: " + list +
    describeBound(
      report, "; held by the angles of ridges and corners: they allow no more than %.4f");
}
}
