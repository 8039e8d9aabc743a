// SPDX-License-Identifier: BSD-3-Clause
// Small polyhedra for tests of PolyhedronSearch: what a few cells of a mesh fill.
#ifndef meshopt_Testing_PolyhedronOfCells_h
#define meshopt_Testing_PolyhedronOfCells_h

#include "Operations/PolyhedronSearch.h"
#include "Quality/Shape.h"
#include "TestMeshes.h"

#include <map>
#include <set>

namespace meshopt
{
struct Polyhedron
{
  std::vector<Vec<3>> points;
  std::vector<PolyhedronSearch::Triangle> facets; // (facet, inner point) is positive
  std::vector<bool> stay;

  Corners<3> corners(const PolyhedronSearch::Tetrahedron& t) const
  {
    return { this->points[t[0]], this->points[t[1]], this->points[t[2]], this->points[t[3]] };
  }
  double quality(const PolyhedronSearch::Tetrahedron& t) const
  {
    return MeanEdgeShape<3>::value(this->corners(t));
  }
  double volume() const
  {
    double sum = 0.0;
    for (const PolyhedronSearch::Triangle& f : this->facets)
    {
      sum += signedVolume(Corners<3>{ this->points[f[0]], this->points[f[1]], this->points[f[2]],
        this->points[this->facets[0][0]] });
    }
    return sum;
  }
};

/// The polyhedron that these cells of a mesh fill; points inside may be dropped if they are free.
inline Polyhedron polyhedronOf(const SimplexMesh<3>& mesh, const std::vector<Index>& cells)
{
  Polyhedron result;
  std::map<Index, int> numbers;
  for (Index c : cells)
  {
    for (Index p : mesh.nodes(c))
    {
      if (numbers.emplace(p, int(numbers.size())).second)
      {
        result.points.push_back(mesh.point(p));
        result.stay.push_back(!mesh.isFree(p));
      }
    }
  }
  for (Index c : cells)
  {
    for (int i = 0; i < 4; ++i)
    {
      const Index h = mesh.adjacent(c, i);
      if (h == None || std::find(cells.begin(), cells.end(), mesh.cellOf(h)) == cells.end())
      {
        const Facet<3> f = mesh.facet(c, i);
        result.facets.push_back({ std::uint8_t(numbers[f[0]]), std::uint8_t(numbers[f[1]]),
          std::uint8_t(numbers[f[2]]) });
      }
    }
  }
  return result;
}

inline void load(PolyhedronSearch& search, const Polyhedron& p)
{
  search.clear();
  for (std::size_t k = 0; k < p.points.size(); ++k)
  {
    search.addPoint(p.points[k], p.stay[k]);
  }
  ASSERT_TRUE(search.setBoundary(p.facets));
  search.findCandidates();
  for (PolyhedronSearch::Candidate& t : search.candidates())
  {
    t.quality = p.quality(t.nodes);
  }
}

/// Cells around cell `seed`, as many as have `points` points.
inline std::vector<Index> someCells(
  const SimplexMesh<3>& mesh, Index seed, int points, TestRandom& random)
{
  std::vector<Index> cells{ seed };
  std::set<Index> nodes(mesh.nodes(seed).begin(), mesh.nodes(seed).end());
  for (int tries = 0; tries < 100; ++tries)
  {
    const Index c = cells[int((random() + 1.0) * 0.4999 * double(cells.size()))];
    const Index h = mesh.adjacent(c, int((random() + 1.0) * 1.999));
    if (h == None || std::find(cells.begin(), cells.end(), mesh.cellOf(h)) != cells.end())
    {
      continue;
    }
    const Index n = mesh.nodes(mesh.cellOf(h))[mesh.facetOf(h)];
    if (nodes.count(n) || int(nodes.size()) < points)
    {
      nodes.insert(n);
      cells.push_back(mesh.cellOf(h));
    }
  }
  return cells;
}
}

#endif
