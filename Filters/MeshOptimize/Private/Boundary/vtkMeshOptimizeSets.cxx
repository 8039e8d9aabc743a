// SPDX-License-Identifier: BSD-3-Clause
// Node sets are seen as parts of the surface: a set that covers whole patches keeps its area, while
// its points come and go.
#include "Boundary/vtkMeshOptimizeSets.h"

#include "Boundary/vtkMeshOptimizeRiding.h"
#include "Grid/vtkMeshOptimizeTransfer.h"

#include "vtkMeshBridgeArrays.h"

#include "vtkDataArray.h"
#include "vtkPointData.h"
#include "vtkUnstructuredGrid.h"

#include "Mesh/Ids.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <map>

namespace vtkMeshOptimizeBridge
{

using meshopt::Facet;
using meshopt::Index;
using meshopt::SimplexMesh;
using meshopt::Vec;

namespace
{

constexpr std::size_t MostSets = 32; // bits
/// An integer array with more values than this counts as one set: all that is not 0. The patch
/// array may use all bits.
constexpr std::size_t MostValues = 4;

using Values = std::vector<double>;

/**
 * What tells points of one set from those of another: empty where there is none.
 */
Values ValueOf(vtkDataArray* array, vtkIdType p)
{
  Values values;
  bool isZero = true;
  for (int i = 0; i < array->GetNumberOfComponents(); ++i)
  {
    values.push_back(array->GetComponent(p, i));
    isZero &= values.back() == 0.0;
  }
  if (isZero)
  {
    return {};
  }
  // Numbers with fractions, such as those of a field, tell no sets apart: only 0 and not 0.
  return vtkMeshBridge::HoldsIntegers(array) ? values : Values{ 1.0 };
}

std::vector<Index> ListSurfacePoints(const SimplexMesh<3>& mesh)
{
  std::vector<Index> points;
  ForKeptFacets(mesh,
    [&](Index c, int i)
    {
      const Facet<3> f = mesh.facet(c, i);
      points.insert(points.end(), f.begin(), f.end());
    });
  std::sort(points.begin(), points.end());
  points.erase(std::unique(points.begin(), points.end()), points.end());
  return points;
}

/**
 * Adds the sets of one array, if there are any and there is room for them.
 */
void AddSets(vtkDataArray* array, const std::vector<Index>& points, std::size_t mostValues,
  std::size_t& used, std::vector<std::uint32_t>& sets, NodeSetArray& found)
{
  std::map<Values, std::size_t> numbers;
  bool hasZero = false;
  for (Index p : points)
  {
    const Values value = ValueOf(array, p);
    hasZero |= value.empty();
    // One more than allowed is enough to know that there are too many.
    if (!value.empty() && numbers.size() <= mostValues)
    {
      numbers.emplace(value, numbers.size());
    }
  }
  const std::size_t n = numbers.size() > mostValues ? 1 : numbers.size();
  // A set that has all points of the surface divides nothing; without zeros there is no outside.
  if (!hasZero || n == 0 || used + n > MostSets)
  {
    return;
  }
  for (Index p : points)
  {
    const Values value = ValueOf(array, p);
    if (!value.empty())
    {
      sets[p] |= std::uint32_t(1) << (used + (n > 1 ? numbers.at(value) : 0));
    }
  }
  for (std::size_t k = 0; k < n; ++k)
  {
    found.Bits |= std::uint32_t(1) << (used + k);
  }
  used += n;
}

/**
 * The patches on which each point of the surface is that moved or is new; by output id, ascending.
 */
std::vector<std::pair<vtkIdType, Index>> ListPatches(
  const SimplexMesh<3>& mesh, const OutputMap& map)
{
  std::vector<char> isSampled(map.PointToSlot.size(), 0);
  for (const vtkIdType id : map.SampledPoints)
  {
    isSampled[id] = 1;
  }
  std::vector<std::pair<vtkIdType, Index>> patches;
  ForKeptFacets(mesh,
    [&](Index c, int i)
    {
      for (Index p : mesh.facet(c, i))
      {
        // A point of a curve is on several patches.
        const vtkIdType id = map.SlotToPoint[p];
        const meshopt::Freedom freedom = mesh.freedom(p);
        const bool slides = freedom == meshopt::Freedom::Patch ||
          freedom == meshopt::Freedom::Curve;
        if (isSampled[id] && slides && mesh.patch(c, i) != meshopt::None)
        {
          patches.emplace_back(id, mesh.patch(c, i));
        }
      }
    });
  std::sort(patches.begin(), patches.end());
  patches.erase(std::unique(patches.begin(), patches.end()), patches.end());
  return patches;
}

/**
 * The place in the input that is nearest to x on the facets of a patch.
 */
Sample SampleFacet(
  const Model<3>& model, const meshopt::SlidingSurface& surface, Index patch, const Vec<3>& x)
{
  const Facet<3>& facet = surface.inputFacet(patch, x);
  Vec<3> corners[3];
  for (int i = 0; i < 3; ++i)
  {
    model.Grid->GetPoint(facet[i], corners[i].data());
  }
  // Barycentric weights as seen along the normal. A point beside the facet has a negative one,
  // which becomes 0.
  const Vec<3> n = (corners[1] - corners[0]).cross(corners[2] - corners[0]);
  Sample sample;
  double sum = 0.0;
  for (int i = 0; i < 3; ++i)
  {
    const Vec<3>&a = corners[(i + 1) % 3], &b = corners[(i + 2) % 3];
    sample.Corners[i] = facet[i];
    // The area of the triangle opposite to the corner, signed by the normal, with a common factor.
    sample.Weights[i] = std::max(0.0, (a - x).cross(b - x).dot(n));
    sum += sample.Weights[i];
  }
  for (int i = 0; i < 3; ++i)
  {
    // A facet without area: any of its corners.
    sample.Weights[i] = sum > 0.0 ? sample.Weights[i] / sum : (i == 0 ? 1.0 : 0.0);
  }
  // Samples have four corners, as those in tetrahedra have.
  sample.Corners[3] = facet[0];
  sample.Weights[3] = 0.0;
  const auto nearest = std::min_element(corners, corners + 3,
    [&](const Vec<3>& a, const Vec<3>& b)
    { return (a - x).squaredNorm() < (b - x).squaredNorm(); });
  sample.Nearest = facet[nearest - corners];
  return sample;
}

} // namespace

std::vector<std::pair<Facet<3>, Index>> LabelByPoints(const Model<3>& model)
{
  std::vector<std::pair<Facet<3>, Index>> labels;
  if (!model.Arrays.PatchIsAtPoints)
  {
    return labels;
  }
  // Numbers of the labels do not matter, only which facets have the same.
  std::map<Values, Index> numbers;
  ForKeptFacets(model.Mesh,
    [&](Index c, int i)
    {
      const Facet<3> f = meshopt::sortedIds(model.Mesh.facet(c, i));
      const Values value = ValueOf(model.Arrays.Patch, f[0]);
      if (!value.empty() && value == ValueOf(model.Arrays.Patch, f[1]) &&
        value == ValueOf(model.Arrays.Patch, f[2]))
      {
        labels.emplace_back(
          f, numbers.emplace(value, static_cast<Index>(numbers.size())).first->second);
      }
    });
  std::sort(labels.begin(), labels.end());
  return labels;
}

void KeepLonePoints(const Model<3>& model, const std::vector<std::pair<Facet<3>, Index>>& labels,
  std::vector<std::uint8_t>& corners)
{
  if (!model.Arrays.PatchIsAtPoints)
  {
    return;
  }
  corners.resize(model.Cells.PointUse.size(), 0);
  std::vector<char> isOnFacet(corners.size(), 0);
  for (const auto& [facet, label] : labels)
  {
    for (Index p : facet)
    {
      isOnFacet[p] = 1;
    }
  }
  for (Index p : ListSurfacePoints(model.Mesh))
  {
    corners[p] |= std::uint8_t(!isOnFacet[p] && !ValueOf(model.Arrays.Patch, p).empty());
  }
}

std::vector<std::uint32_t> FindNodeSets(Model<3>& model)
{
  vtkPointData* data = model.Grid->GetPointData();
  std::vector<std::uint32_t> sets(model.Cells.PointUse.size(), 0);
  // Only points of the surface: inside, a set means nothing to it.
  const std::vector<Index> points = ListSurfacePoints(model.Mesh);
  std::size_t used = 0;
  model.NodeSets.clear();
  // The patch array first: its sets must find room.
  for (int round = 0; round < 2; ++round)
  {
    for (int k = 0; k < data->GetNumberOfArrays(); ++k)
    {
      vtkDataArray* array = data->GetArray(k);
      // Ids tell points apart: they are no sets.
      if (array && !vtkMeshBridge::HoldsIds(data, k) &&
        (array == model.Arrays.Patch) == (round == 0))
      {
        NodeSetArray found;
        found.Array = k;
        AddSets(array, points, round == 0 ? MostSets : MostValues, used, sets, found);
        if (found.Bits != 0)
        {
          model.NodeSets.push_back(found);
        }
      }
    }
  }
  return used > 0 ? sets : std::vector<std::uint32_t>();
}

void TransferNodeSets(
  const Model<2>&, const meshopt::BoundaryCurves&, const OutputMap&, vtkDataSetAttributes*)
{
}

void TransferNodeSets(const Model<3>& model, const meshopt::SlidingSurface& surface,
  const OutputMap& map, vtkDataSetAttributes* output)
{
  // Sets that the surface cannot follow are interpolated like all other data.
  const bool hasSets = std::any_of(model.NodeSets.begin(), model.NodeSets.end(),
    [&](const NodeSetArray& set) { return (set.Bits & ~surface.sets()) == 0; });
  const auto patches = hasSets ? ListPatches(model.Mesh, map)
                               : std::vector<std::pair<vtkIdType, Index>>();
  for (const NodeSetArray& set : model.NodeSets)
  {
    if ((set.Bits & ~surface.sets()) != 0)
    {
      continue;
    }
    vtkDataArray* source = model.Grid->GetPointData()->GetArray(set.Array);
    vtkDataArray* array = output->GetArray(set.Array); // in the order of the input
    for (const vtkIdType id : map.SampledPoints)
    {
      const Index p = map.PointToSlot[id];
      if (model.Mesh.freedom(p) == meshopt::Freedom::Corner)
      {
        array->SetTuple(id, p, source); // corners have some room, but stay what they are
      }
    }
    for (std::size_t first = 0, last = 0; first < patches.size(); first = last)
    {
      const vtkIdType id = patches[first].first;
      Index inside = meshopt::None; // a patch at the point that is in the set
      for (last = first; last < patches.size() && patches[last].first == id; ++last)
      {
        const Index patch = patches[last].second;
        inside = (surface.setsOfPatch(patch) & set.Bits) != 0 ? patch : inside;
      }
      // On no patch of the set: outside of it.
      if (inside == meshopt::None)
      {
        for (int i = 0; i < array->GetNumberOfComponents(); ++i)
        {
          array->SetComponent(id, i, 0.0);
        }
        continue;
      }
      const Vec<3> x = model.Mesh.point(map.PointToSlot[id]);
      SetSample(source, SampleFacet(model, surface, inside, x), array, id);
    }
  }
}

} // namespace vtkMeshOptimizeBridge
