// SPDX-License-Identifier: BSD-3-Clause
// A tree of the facets that have changed; each facet of the surface asks it.
#include "Surface/NewCrossings.h"

#include "Base/SortUnique.h"
#include "Mesh/Ids.h"
#include "Surface/SurfaceFaults.h"

#include <algorithm>

namespace meshopt
{
namespace
{
/// The kept facets (sorted ids), each once, in order.
template <int D>
std::vector<Facet<D>> surfaceOf(const SimplexMesh<D>& mesh)
{
  std::vector<Facet<D>> facets;
  for (Index c = 0; c < mesh.numberOfCellSlots(); ++c)
  {
    for (int i = 0; i <= D && mesh.isAlive(c); ++i)
    {
      if (mesh.isKept(c, i))
      {
        facets.push_back(sortedIds(mesh.facet(c, i)));
      }
    }
  }
  sortUnique(facets); // those between regions come from both sides
  return facets;
}

template <int D>
BoxTree::Box boxAround(const SimplexMesh<D>& mesh, const Facet<D>& f)
{
  std::array<Vec<D>, D> x;
  std::transform(f.begin(), f.end(), x.begin(), [&](Index p) { return mesh.point(p); });
  return BoxTree::around(x);
}

template <int D>
int countShared(const Facet<D>& f, const Facet<D>& g)
{
  return static_cast<int>(std::count_if(f.begin(), f.end(), [&](Index p) { return hasId(g, p); }));
}
}

template <int D>
std::vector<BoxTree::Box> findNewCrossings(
  const SimplexMesh<D>& before, const SimplexMesh<D>& now, const CrossingCounts<D>& counts)
{
  const std::vector<Facet<D>> old = surfaceOf(before), facets = surfaceOf(now);
  std::vector<BoxTree::Item> changed;
  for (std::size_t k = 0; k < facets.size(); ++k)
  {
    const Facet<D>& f = facets[k];
    const bool isOld = std::binary_search(old.begin(), old.end(), f) &&
      std::all_of(f.begin(), f.end(), [&](Index p) { return before.point(p) == now.point(p); });
    if (!isOld)
    {
      changed.push_back({ static_cast<int>(k), boxAround<D>(now, f) });
    }
  }
  BoxTree tree;
  tree.build(changed);
  std::vector<BoxTree::Box> boxes;
  for (const Facet<D>& f : facets)
  {
    const BoxTree::Box box = boxAround<D>(now, f);
    tree.findTouching(box,
      [&](int k)
      {
        if (countShared<D>(f, facets[k]) < D - 1 && facetsCross(now, f, facets[k]) &&
          (!counts || counts(now, f, facets[k])))
        {
          boxes.push_back(box);
          boxes.push_back(boxAround<D>(now, facets[k]));
        }
      });
  }
  return boxes;
}

template std::vector<BoxTree::Box> findNewCrossings<2>(
  const SimplexMesh<2>&, const SimplexMesh<2>&, const CrossingCounts<2>&);
template std::vector<BoxTree::Box> findNewCrossings<3>(
  const SimplexMesh<3>&, const SimplexMesh<3>&, const CrossingCounts<3>&);
}
