// SPDX-License-Identifier: BSD-3-Clause
/**
 * Figures of a mesh that is divided among ranks, and what must stay the same when cells move from
 * rank to rank.
 */
#ifndef vtkMeshRanksCheck_h
#define vtkMeshRanksCheck_h

#include "Ranks/vtkMeshRanksFacets.h"

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace vtkMeshRanks
{

/**
 * Qualities and counts of the whole, the same bits on all ranks.
 */
struct Figures
{
  vtkIdType Cells = 0, Points = 0, BelowTarget = 0, NotPositive = 0;
  double Worst = 0.0, Mean = 0.0; ///< 0 without cells
};

Figures Measure(const Ranks& ranks, const Part& part, const Shared& shared, double target);

/**
 * What tells two divisions of one mesh from two meshes.
 *
 * Surface combines by exclusive or, over all cells, the hashes of their facets (of ids and bits of
 * coordinates). A facet that two cells have, on the same rank or not, comes twice and cancels out,
 * so only the true surface is left: a facet that is missing, moved, or not the same on both sides
 * changes the result. The order in which a cell lists its points does not: cells that are numbered
 * the wrong way round may be turned by any run.
 */
struct Signature
{
  vtkIdType Cells = 0;
  std::uint64_t Ids = 0; ///< the sum of the hashes of the cells' ids
  double Volume = 0.0;   ///< for triangles the area
  std::uint64_t Surface = 0;
};

/**
 * `normal`: of the plane of triangles, whose areas have signs.
 */
Signature Sign(const Ranks& ranks, const Part& part, const std::array<double, 3>& normal);

/**
 * The hashes, ascending, of the facets that one cell of this part has and whose nodes all are on
 * the Hull: by ids and bits of coordinates.
 */
std::vector<std::uint64_t> HashesOfHull(const Part& part);

/**
 * Whether a cell of this part is flat, or numbered as if it were inverted.
 */
bool HasNotPositive(const Part& part, const std::array<double, 3>& normal);

/**
 * Whether this part has a facet of more than two cells, of all ranks together, with all nodes on
 * the Skin. Valid meshes never get one. But where cells lie on each other, two runs side by side
 * may both make the same facet of nodes that they share. Collective.
 */
bool HasOverusedFacet(const Ranks& ranks, const Part& part);

/**
 * Whether pieces of different ranks lie on each other: most facets that two of them have belong to
 * the same cell, or no facet is of one piece alone, and most have both cells on one side. So it is
 * where each rank has read the whole mesh. By places, so that ids do not matter. `open`: all facets
 * that have one cell in the part. Collective.
 */
bool DoPiecesCoincide(const Ranks& ranks, const Part& part, const std::vector<CellFacet>& open,
  const std::array<double, 3>& normal);

/**
 * An error if `after` is not of the same mesh as `before`; `cells` says whether the cells must be
 * the same, too, by number and ids. Volumes may differ by rounding;
 * with `isTangled` they are not compared, since cells may be turned.
 */
std::string Compare(
  const Signature& before, const Signature& after, bool cells, bool isTangled = false);

} // namespace vtkMeshRanks

#endif
