// SPDX-License-Identifier: BSD-3-Clause
// Explains cells that stay inverted. Users can mend a surface if they know where it is wrong: so
// each reason comes with examples.
#include "OneGrid/vtkMeshOptimizeTangle.h"

#include "vtkIdList.h"
#include "vtkNew.h"
#include "vtkUnstructuredGrid.h"

#include "Mesh/Ids.h"
#include "Surface/SurfaceFaults.h"

#include <algorithm>
#include <sstream>

namespace vtkMeshOptimizeBridge
{

using meshopt::Facet;
using meshopt::Index;
using meshopt::SimplexMesh;
using meshopt::SurfaceFault;

namespace
{

// A sentence, not a list: who needs all finds them by their quality.
constexpr std::size_t NumberOfExamples = 5;

/**
 * The first three are the same as in SurfaceFault::Kind.
 */
enum Reason
{
  NoArea,
  Folded,
  Crossing,
  EndedEarly,
  AllKept,
  NothingFound,
  NumberOfReasons
};

using Kind = SurfaceFault<3>::Kind;
static_assert(NoArea == static_cast<int>(Kind::NoArea));
static_assert(Folded == static_cast<int>(Kind::Folded));
static_assert(Crossing == static_cast<int>(Kind::Crossing));

/**
 * Cells of the output with the same reason.
 */
struct Group
{
  std::vector<std::size_t> Cells;
  std::string Faces; ///< of the surface, for the first cell
};

template <int D>
std::string ListPoints(const Facet<D>& facet)
{
  std::string text;
  for (Index p : facet)
  {
    text += (text.empty() ? "" : " ") + std::to_string(p);
  }
  return text;
}

template <int D>
std::string ListFaces(const SurfaceFault<D>& fault)
{
  const std::string text = ListPoints<D>(fault.facets[0]);
  return fault.kind == SurfaceFault<D>::NoArea ? text
                                               : text + " and " + ListPoints<D>(fault.facets[1]);
}

/**
 * Faults by point; those of facets without area by facet.
 */
template <int D>
class FaultFinder
{
public:
  FaultFinder(const SimplexMesh<D>& mesh, const std::vector<Index>& slots)
    : Mesh(mesh)
    , Faults(meshopt::findSurfaceFaults(mesh, slots))
    , FaultOfPoint(mesh.numberOfPointSlots(), nullptr)
  {
    // From the last to the first, so that the first one is written last.
    for (auto fault = this->Faults.rbegin(); fault != this->Faults.rend(); ++fault)
    {
      if (fault->kind == SurfaceFault<D>::NoArea)
      {
        continue;
      }
      for (const Facet<D>& facet : fault->facets)
      {
        for (Index p : facet)
        {
          this->FaultOfPoint[p] = &*fault; // the first fault in the list stays
        }
      }
    }
  }

  /// Explains a cell: by an own facet without area, otherwise by a fault at its neighbours' nodes.
  const SurfaceFault<D>* Find(Index slot) const
  {
    const SurfaceFault<D>* found = this->FindFacet(slot);
    std::vector<Index> star;
    for (int i = 0; i <= D && !found; ++i)
    {
      // Faults of neighbours count: a cell is pressed flat by what is beside it.
      this->Mesh.star(this->Mesh.nodes(slot)[i], star);
      for (Index c : star)
      {
        for (Index p : this->Mesh.nodes(c))
        {
          const SurfaceFault<D>* fault = this->FaultOfPoint[p];
          // In the order of the list, which is by kind.
          found = fault && (!found || fault < found) ? fault : found;
        }
      }
    }
    return found;
  }

private:
  const SurfaceFault<D>* FindFacet(Index slot) const
  {
    // Sorted by kind, those without area first, then by points: with many flat faces, to walk over
    // all of them for each cell would take longer than the run.
    const auto end = std::partition_point(this->Faults.begin(), this->Faults.end(),
      [](const SurfaceFault<D>& fault) { return fault.kind == SurfaceFault<D>::NoArea; });
    const SurfaceFault<D>* first = nullptr;
    for (int i = 0; i <= D; ++i)
    {
      const Facet<D> key = meshopt::sortedIds(this->Mesh.facet(slot, i));
      const auto found = std::lower_bound(this->Faults.begin(), end, key,
        [](const SurfaceFault<D>& fault, const Facet<D>& f) { return fault.facets[0] < f; });
      const bool isIt = found != end && found->facets[0] == key;
      first = isIt && (!first || &*found < first) ? &*found : first;
    }
    return first;
  }

  const SimplexMesh<D>& Mesh;
  std::vector<SurfaceFault<D>> Faults; ///< by kind
  std::vector<const SurfaceFault<D>*> FaultOfPoint;
};

template <int D>
Reason FindReason(const SimplexMesh<D>& mesh, const meshopt::Report& report, Index slot)
{
  using meshopt::StopReason;
  // First: of a run that was ended early nothing else can be said.
  if (report.stopReason == StopReason::Aborted || report.stopReason == StopReason::TimeLimit ||
    report.stopReason == StopReason::IterationLimit)
  {
    return EndedEarly;
  }
  const auto& nodes = mesh.nodes(slot);
  return std::all_of(nodes.begin(), nodes.end(), [&](Index p) { return !mesh.isFree(p); })
    ? AllKept
    : NothingFound;
}

/**
 * A part of a sentence, which follows a number of cells.
 */
std::string Explain(Reason reason, const std::string& faces, int dimension)
{
  const std::string noun = dimension == 3 ? "faces" : "edges";
  const std::string points = " (points of the input " + faces + ")";
  switch (reason)
  {
    case NoArea:
      return (dimension == 3 ? "with a face without area on the kept surface"
                             : "with an edge without length on the kept boundary") +
        points;
    case Folded:
      return "where kept " + noun + " are folded onto each other" + points;
    case Crossing:
      return "where kept " + noun + " pass through each other" + points;
    case EndedEarly:
      return "left because the run was ended early";
    // Only if no fault of the surface explains it.
    case AllKept:
      return "with no node that may move (surface, " + noun +
        " between regions, fixed points) and no other connection found";
    default:
      return "that nothing tried could repair";
  }
}

std::string ListCells(vtkUnstructuredGrid* output, const OutputMap& map, const Group& group)
{
  std::ostringstream text;
  vtkNew<vtkIdList> ids;
  for (std::size_t k = 0; k < std::min(group.Cells.size(), NumberOfExamples); ++k)
  {
    const std::size_t cell = group.Cells[k];
    text << (k == 0 ? "" : ", ");
    // By the user's number where the cell has one, otherwise by its place.
    if (static_cast<vtkIdType>(cell) < map.NumberOfOldCells)
    {
      text << "cell " << map.CellToSource[cell];
      continue;
    }
    double centre[3] = { 0.0, 0.0, 0.0 };
    output->GetCellPoints(static_cast<vtkIdType>(cell), ids);
    for (vtkIdType i = 0; i < ids->GetNumberOfIds(); ++i)
    {
      double x[3];
      output->GetPoint(ids->GetId(i), x);
      for (int d = 0; d < 3; ++d)
      {
        centre[d] += x[d] / static_cast<double>(ids->GetNumberOfIds());
      }
    }
    text << "cell " << cell << " of the output, at (" << centre[0] << ", " << centre[1] << ", "
         << centre[2] << ")";
  }
  return text.str() + (group.Cells.size() > NumberOfExamples ? ", ..." : "");
}

} // namespace

template <int D>
std::string DescribeTangle(vtkUnstructuredGrid* output, const OutputMap& map,
  const SimplexMesh<D>& mesh, const meshopt::Report& report)
{
  std::vector<std::size_t> bad;
  std::vector<Index> slots;
  for (std::size_t c = 0; c < map.CellToSlot.size(); ++c)
  {
    const Index slot = map.CellToSlot[c];
    // Written so that a quality that is not a number counts, too.
    if (slot != meshopt::None && !(mesh.quality(slot) > 0.0))
    {
      bad.push_back(c);
      slots.push_back(slot);
    }
  }
  if (bad.empty())
  {
    return {};
  }
  const FaultFinder<D> finder(mesh, slots);
  Group groups[NumberOfReasons];
  for (std::size_t k = 0; k < bad.size(); ++k)
  {
    // A fault explains more than how the run ended.
    const SurfaceFault<D>* fault = finder.Find(slots[k]);
    Group& group =
      groups[fault ? static_cast<Reason>(fault->kind) : FindReason(mesh, report, slots[k])];
    // Of the first cell only: one place to look at is enough for each reason.
    if (group.Cells.empty() && fault)
    {
      group.Faces = ListFaces<D>(*fault);
    }
    group.Cells.push_back(bad[k]);
  }
  std::string text = bad.size() == 1
    ? "1 cell is still inverted or flat: "
    : std::to_string(bad.size()) + " cells are still inverted or flat: ";
  const char* separator = "";
  for (int reason = 0; reason < NumberOfReasons; ++reason)
  {
    const Group& group = groups[reason];
    if (!group.Cells.empty())
    {
      text += separator + std::to_string(group.Cells.size()) + " " +
        Explain(static_cast<Reason>(reason), group.Faces, D) + ", " + ListCells(output, map, group);
      separator = "; ";
    }
  }
  return text + ".";
}

template <int D>
std::string DescribeOverlap(const SimplexMesh<D>& mesh)
{
  // Found when the mesh was built, before anything changed.
  const Index folds = mesh.numberOfFoldedFacets();
  if (folds == 0)
  {
    return {};
  }
  const std::string noun = D == 3 ? " face" : " edge";
  return "Cells of the input overlap, though none of them is inverted: at " +
    std::to_string(folds) + (folds == 1 ? noun : noun + "s") +
    " both cells lie on the same side (the first one has the points of the input " +
    ListPoints<D>(mesh.firstFoldedFacet()) + "). They have not been renumbered.";
}

template std::string DescribeOverlap<2>(const SimplexMesh<2>&);
template std::string DescribeOverlap<3>(const SimplexMesh<3>&);
template std::string DescribeTangle<2>(
  vtkUnstructuredGrid*, const OutputMap&, const SimplexMesh<2>&, const meshopt::Report&);
template std::string DescribeTangle<3>(
  vtkUnstructuredGrid*, const OutputMap&, const SimplexMesh<3>&, const meshopt::Report&);

} // namespace vtkMeshOptimizeBridge
