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
std::vector<Facet<3>> surfaceOf(const SimplexMesh<3>& mesh)
{
  std::vector<Facet<3>> facets;
  for (Index c = 0; c < mesh.numberOfCellSlots(); ++c)
  {
    for (int i = 0; i < 4 && mesh.isAlive(c); ++i)
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

BoxTree::Box boxAround(const SimplexMesh<3>& mesh, const Facet<3>& f)
{
  return BoxTree::around(std::array{ mesh.point(f[0]), mesh.point(f[1]), mesh.point(f[2]) });
}

int countShared(const Facet<3>& f, const Facet<3>& g)
{
  return static_cast<int>(std::count_if(f.begin(), f.end(), [&](Index p) { return hasId(g, p); }));
}
}

std::vector<BoxTree::Box> findNewCrossings(const SimplexMesh<3>& before, const SimplexMesh<3>& now)
{
  const std::vector<Facet<3>> old = surfaceOf(before), facets = surfaceOf(now);
  std::vector<BoxTree::Item> changed;
  for (std::size_t k = 0; k < facets.size(); ++k)
  {
    const Facet<3>& f = facets[k];
    const bool isOld = std::binary_search(old.begin(), old.end(), f) &&
      std::all_of(f.begin(), f.end(), [&](Index p) { return before.point(p) == now.point(p); });
    if (!isOld)
    {
      changed.push_back({ static_cast<int>(k), boxAround(now, f) });
    }
  }
  BoxTree tree;
  tree.build(changed);
  std::vector<BoxTree::Box> boxes;
  for (const Facet<3>& f : facets)
  {
    const BoxTree::Box box = boxAround(now, f);
    tree.findTouching(box,
      [&](int k)
      {
        if (countShared(f, facets[k]) < 2 && facetsCross(now, f, facets[k]))
        {
          boxes.push_back(box);
          boxes.push_back(boxAround(now, facets[k]));
        }
      });
  }
  return boxes;
}
}
