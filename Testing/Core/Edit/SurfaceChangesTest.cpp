// SPDX-License-Identifier: BSD-3-Clause
// What a surface is told of a change: the facets that go and come, the spans and the angles,
// against a search of the whole mesh before and after.
#include "Edit/SurfaceChanges.h"

#include "Mesh/CavityFit.h"
#include "Operations/EdgeContraction.h"
#include "Operations/EdgeSplit.h"
#include "TestMeshes.h"

#include <functional>
#include <map>

using namespace meshopt;

namespace
{
/// Lets everything be done, and writes down what it is asked.
template <int D>
class Recorder final : public Surface<D>
{
public:
  struct Angle
  {
    std::array<Index, 2> edge;
    bool isKept;
    double cosine;
  };
  mutable std::vector<SurfaceChange<D>> changes;
  mutable std::vector<Angle> angles, anglesOutside;
  bool answer = true;
  double leastCosine = -2.0;                ///< an angle with less is refused
  std::set<std::array<Index, 2>> offCurves; ///< edges that have no span
  std::function<std::uint32_t(Index)> setsOf = [](Index) { return 0u; };

  Vec<D> at(Index, double) const override { return Vec<D>::Zero(); }
  Place project(const Place& place, const Vec<D>& x, Vec<D>& there) const override
  {
    there = x;
    return place;
  }
  int tangents(
    const SimplexMesh<D>&, const std::vector<Index>&, Index, std::array<Vec<D>, D>&) const override
  {
    return 0;
  }
  /// The span of an edge has its ids for parameters: so a test knows it again.
  std::optional<Span> span(const SimplexMesh<D>&, Index a, Index b) const override
  {
    const auto edge = sortedIds(a, b);
    return this->offCurves.count(edge) > 0
      ? std::nullopt
      : std::optional<Span>(Span{ 0, double(edge[0]), double(edge[1]) });
  }
  std::optional<SlidingRange> range(
    const SimplexMesh<D>&, const std::vector<Index>&, Index) const override
  {
    return std::nullopt;
  }
  bool mayDivide(const SimplexMesh<D>&, const std::vector<Index>&, Index, Index) const override
  {
    return true;
  }
  bool maySwap(const SimplexMesh<D>&, Index, Index) const override { return true; }
  bool mayJoin(const SimplexMesh<D>&, const std::vector<Index>&, Index, Index) const override
  {
    return true;
  }
  std::uint32_t sets(const SimplexMesh<D>&, Index v) const override { return this->setsOf(v); }
  bool allows(const SurfaceChange<D>& change) const override
  {
    this->changes.push_back(change);
    return this->answer;
  }
  bool allowsAngle(
    const SimplexMesh<D>&, Index a, Index b, bool isKept, double cosine) const override
  {
    this->angles.push_back({ sortedIds(a, b), isKept, cosine });
    return cosine >= this->leastCosine;
  }
  bool allowsAngleOutside(const SimplexMesh<D>&, Index a, Index b, double cosine) const override
  {
    this->anglesOutside.push_back({ sortedIds(a, b), false, cosine });
    return cosine >= this->leastCosine;
  }
};

/// A side of a facet that is on the surface.
template <int D>
struct Side
{
  Simplex<D> cell;
  Facet<D> facet; ///< as seen from the cell
  Index region;
};

/// All facets with one cell, or with cells of two regions, by sorted ids.
template <int D>
using Sides = std::map<Facet<D>, std::vector<Side<D>>>;

template <int D>
Sides<D> surfaceOf(const std::vector<Simplex<D>>& cells, const std::vector<Index>& regions)
{
  Sides<D> all, kept;
  for (std::size_t c = 0; c < cells.size(); ++c)
  {
    for (int i = 0; i <= D; ++i)
    {
      Facet<D> f;
      for (int k = 0; k < D; ++k)
      {
        f[k] = cells[c][Local<D>::facets[i][k]];
      }
      all[sortedIds(f)].push_back({ cells[c], f, regions[c] });
    }
  }
  for (const auto& [key, sides] : all)
  {
    if (sides.size() == 1 || sides[0].region != sides[1].region)
    {
      kept[key] = sides;
    }
  }
  return kept;
}

/// A box of two regions whose surface takes part: one patch a side, and one for the interface.
template <int D>
struct Box
{
  SimplexMesh<D> mesh;
  MeshEditor<D> editor;
  Recorder<D> surface;
  SurfaceChanges<D> changes;
  Proposal<D> proposal;

  static MeshInput<D> input()
  {
    MeshInput<D> in = jitteredGrid<D>(4, 0.2);
    splitRegions(in);
    return in;
  }

  Box()
    : mesh(buildMesh(input()))
    , editor(mesh)
  {
    for (Index c = 0; c < this->mesh.numberOfCellSlots(); ++c)
    {
      for (int i = 0; i <= D; ++i)
      {
        if (this->mesh.isKept(c, i))
        {
          this->editor.setPatch(c, i, this->patchOf(this->mesh.facet(c, i)));
        }
      }
    }
  }

  /// The number of the plane in which the facet lies; 2 D inside.
  Index patchOf(const Facet<D>& f) const
  {
    for (int k = 0; k < 2 * D; ++k)
    {
      const double at = k % 2;
      if (std::all_of(
            f.begin(), f.end(), [&](Index p) { return this->mesh.point(p)[k / 2] == at; }))
      {
        return k;
      }
    }
    return 2 * D;
  }

  Sides<D> sides(const std::vector<Index>& without = {}, const Proposal<D>* with = nullptr) const
  {
    std::vector<Simplex<D>> cells;
    std::vector<Index> regions;
    for (Index c = 0; c < this->mesh.numberOfCellSlots(); ++c)
    {
      if (this->mesh.isAlive(c) && std::find(without.begin(), without.end(), c) == without.end())
      {
        cells.push_back(this->mesh.nodes(c));
        regions.push_back(this->mesh.region(c));
      }
    }
    if (with)
    {
      cells.insert(cells.end(), with->cells.begin(), with->cells.end());
      regions.insert(regions.end(), with->kept.regions.begin(), with->kept.regions.end());
    }
    return surfaceOf<D>(cells, regions);
  }

  /// Is `pieces` the list of these facets, each once, seen from one of its sides?
  void expectPieces(const std::vector<SurfacePiece<D>>& pieces, const Sides<D>& facets) const
  {
    EXPECT_EQ(pieces.size(), facets.size());
    std::set<Facet<D>> seen;
    for (const SurfacePiece<D>& piece : pieces)
    {
      bool isFound = false;
      for (const auto& [key, sides] : facets)
      {
        for (const Side<D>& side : sides)
        {
          std::array<Vec<D>, D> x;
          for (int k = 0; k < D; ++k)
          {
            x[k] = this->mesh.point(side.facet[k]);
          }
          if (x == piece.x && side.region == piece.region)
          {
            isFound = true;
            EXPECT_TRUE(seen.insert(key).second) << "twice";
            EXPECT_EQ(piece.patch, this->patchOf(side.facet));
            std::uint32_t sets = ~0u;
            for (Index p : side.facet)
            {
              sets &= this->surface.setsOf(p);
            }
            EXPECT_EQ(piece.sets, sets);
          }
        }
      }
      EXPECT_TRUE(isFound) << "no facet of the mesh, or not as seen from its region";
    }
  }

  /// Those of a that are not in b.
  static Sides<D> less(const Sides<D>& a, const Sides<D>& b)
  {
    Sides<D> rest;
    for (const auto& entry : a)
    {
      if (b.count(entry.first) == 0)
      {
        rest.insert(entry);
      }
    }
    return rest;
  }

  /// Asks about the proposal; compares what the surface is told with the mesh before and after.
  void check()
  {
    this->surface.changes.clear();
    EXPECT_TRUE(this->changes.allowsReplacement(this->surface, this->mesh, this->proposal));
    ASSERT_EQ(this->surface.changes.size(), 1u);
    const Sides<D> before = this->sides();
    const Sides<D> after = this->sides(this->proposal.cavity, &this->proposal);
    this->expectPieces(this->surface.changes[0].gone, less(before, after));
    this->expectPieces(this->surface.changes[0].come, less(after, before));
    this->surface.answer = false;
    EXPECT_FALSE(this->changes.allowsReplacement(this->surface, this->mesh, this->proposal));
    this->surface.answer = true;
  }

  /// The edges of the surface, each with a cell.
  std::map<std::array<Index, 2>, Index> surfaceEdges() const
  {
    std::map<std::array<Index, 2>, Index> edges;
    for (Index c = 0; c < this->mesh.numberOfCellSlots(); ++c)
    {
      for (int i = 0; i <= D; ++i)
      {
        const Facet<D> f = this->mesh.facet(c, i);
        for (int k = 0; k < D && this->mesh.isKept(c, i); ++k)
        {
          edges[sortedIds(f[k], f[(k + 1) % D])] = c;
        }
      }
    }
    return edges;
  }
};
}

template <class T>
class SurfaceChangesIn : public ::testing::Test
{
};
TYPED_TEST_SUITE(SurfaceChangesIn, TestDimensions);

TYPED_TEST(SurfaceChangesIn, EdgesThatAreDivided)
{
  constexpr int D = TypeParam::dimension;
  Box<D> box;
  box.surface.setsOf = [](Index p) { return static_cast<std::uint32_t>(p) * 2654435761u; };
  int interfaces = 0;
  for (const auto& [edge, cell] : box.surfaceEdges())
  {
    SCOPED_TRACE("edge " + std::to_string(edge[0]) + " " + std::to_string(edge[1]));
    const auto mark = box.editor.begin();
    const Index m = box.editor.addPoint(0.5 * (box.mesh.point(edge[0]) + box.mesh.point(edge[1])));
    ASSERT_TRUE(proposeSplit<D>(box.editor, &box.surface, cell, edge[0], edge[1], m, box.proposal));
    box.check();
    for (const SurfacePiece<D>& piece : box.surface.changes[0].come)
    {
      interfaces += piece.patch == 2 * D;
    }
    box.editor.rollback(mark);
  }
  EXPECT_GT(interfaces, 0);
}

/// A node may become one with any neighbour that is on all of its patches, unless the cells would
/// not fit.
TYPED_TEST(SurfaceChangesIn, NodesThatVanish)
{
  constexpr int D = TypeParam::dimension;
  Box<D> box;
  std::map<Index, std::set<Index>> patches; // of points
  for (const auto& entry : box.sides())
  {
    for (Index p : entry.first)
    {
      patches[p].insert(box.patchOf(entry.first));
    }
  }
  int checked = 0;
  for (const auto& entry : box.surfaceEdges())
  {
    for (const auto& [v, u] :
      { entry.first, std::array<Index, 2>{ entry.first[1], entry.first[0] } })
    {
      SCOPED_TRACE("node " + std::to_string(v) + " into " + std::to_string(u));
      const std::set<Index>&of = patches[v], &with = patches[u];
      if (std::includes(with.begin(), with.end(), of.begin(), of.end()) &&
        proposeContraction<D>(box.editor, &box.surface, v, u, box.proposal) &&
        fillsCavity<D>(
          box.mesh, box.proposal.cavity, box.proposal.cells, box.proposal.keptChange()))
      {
        box.check();
        ++checked;
      }
    }
  }
  EXPECT_GT(checked, D == 2 ? 10 : 100);
}

/// A facet that goes and comes again is on both lists.
TYPED_TEST(SurfaceChangesIn, FacetsThatComeAgain)
{
  constexpr int D = TypeParam::dimension;
  Box<D> box;
  Index c = 0;
  int i = 0;
  while (!box.mesh.isKept(c, i))
  {
    c += i == D;
    i = i == D ? 0 : i + 1;
  }
  box.proposal.cavity = { c };
  box.proposal.cells = { box.mesh.nodes(c) };
  box.proposal.changesKept = true;
  box.proposal.kept.regions = { box.mesh.region(c) };
  Facet<D> turned = box.mesh.facet(c, i);
  box.proposal.kept.gone = { turned };
  std::swap(turned[0], turned[1]); // ids in any order
  box.proposal.kept.come = { turned };
  box.proposal.kept.patches = { box.mesh.patch(c, i) };
  EXPECT_TRUE(box.changes.allowsReplacement(box.surface, box.mesh, box.proposal));
  ASSERT_EQ(box.surface.changes.size(), 1u);
  Sides<D> one;
  const auto all = box.sides();
  one.insert(*all.find(sortedIds(turned)));
  box.expectPieces(box.surface.changes[0].gone, one);
  box.expectPieces(box.surface.changes[0].come, one);
}

/// Nodes slide: the same facets before and after, where they are. Free nodes that move with them do
/// not count.
TYPED_TEST(SurfaceChangesIn, NodesThatMove)
{
  constexpr int D = TypeParam::dimension;
  Box<D> box;
  TestRandom random(1);
  std::vector<Index> star;
  for (Index v = 0; v < box.mesh.numberOfPointSlots(); ++v)
  {
    if (box.mesh.isFree(v))
    {
      continue;
    }
    SCOPED_TRACE("node " + std::to_string(v));
    box.proposal.clear();
    box.mesh.star(v, box.proposal.cavity);
    const Simplex<D> first = box.mesh.nodes(box.proposal.cavity[0]);
    const Index other = first[0] == v ? first[1] : first[0];
    box.mesh.star(other, star);
    for (Index c : star) // of two nodes the cells of both, each once
    {
      if (std::find(box.proposal.cavity.begin(), box.proposal.cavity.end(), c) ==
        box.proposal.cavity.end())
      {
        box.proposal.cavity.push_back(c);
      }
    }
    const bool bothSlide = !box.mesh.isFree(other);
    Vec<D> by;
    for (double& x : by)
    {
      x = 0.01 * random();
    }
    const Place place{ Freedom::Patch, 0, 0.0 };
    box.proposal.moves.push_back({ v, box.mesh.point(v) + by, place });
    box.proposal.moves.push_back(
      { other, box.mesh.point(other) - by, bothSlide ? place : Place() });
    Sides<D> moved;
    for (const auto& entry : box.sides())
    {
      if (hasId(entry.first, v) || (bothSlide && hasId(entry.first, other)))
      {
        moved.insert(entry);
      }
    }
    box.surface.changes.clear();
    box.changes.beforeMoves(box.surface, box.mesh, box.proposal);
    const auto mark = box.editor.begin();
    for (const auto& move : box.proposal.moves)
    {
      box.editor.movePoint(move.point, move.x);
    }
    EXPECT_TRUE(box.changes.allowsMoves(box.surface, box.mesh, box.proposal));
    ASSERT_EQ(box.surface.changes.size(), 1u);
    const SurfaceChange<D> change = box.surface.changes[0];
    box.surface.answer = false;
    EXPECT_FALSE(box.changes.allowsMoves(box.surface, box.mesh, box.proposal));
    box.surface.answer = true;
    ASSERT_EQ(change.gone.size(), change.come.size());
    for (std::size_t k = 0; k < change.gone.size(); ++k)
    {
      EXPECT_EQ(change.gone[k].patch, change.come[k].patch);
      EXPECT_EQ(change.gone[k].region, change.come[k].region);
      for (int n = 0; n < D; ++n)
      {
        const Vec<D> way = change.come[k].x[n] - change.gone[k].x[n];
        EXPECT_TRUE(way.isZero() || way.isApprox(by, 1e-12) || way.isApprox(-by, 1e-12));
      }
    }
    box.editor.rollback(mark);
    box.expectPieces(change.gone, moved); // with patches by their places: not while it is moved
  }
}

// ---- curves (3D) --------------------------------------------------------------------------------

namespace
{
/// Marks the edges of the cube as curves.
std::set<std::array<Index, 2>> keepEdgesOfTheCube(Box<3>& box)
{
  std::set<std::array<Index, 2>> kept;
  for (const auto& [edge, cell] : box.surfaceEdges())
  {
    const Vec<3> a = box.mesh.point(edge[0]), b = box.mesh.point(edge[1]);
    int planes = 0;
    for (int k = 0; k < 3; ++k)
    {
      planes += a[k] == b[k] && (a[k] == 0.0 || a[k] == 1.0);
    }
    if (planes == 2)
    {
      box.editor.keepEdge(cell, edge[0], edge[1]);
      kept.insert(edge);
    }
  }
  return kept;
}

std::set<std::array<Index, 2>> edgesOf(const std::vector<Span>& spans)
{
  std::set<std::array<Index, 2>> edges;
  for (const Span& s : spans)
  {
    edges.insert({ static_cast<Index>(s.from), static_cast<Index>(s.to) });
  }
  return edges;
}
}

/// The halves of an edge on a curve are told as spans. If one of them is on none, the surface need
/// not be asked.
TEST(SurfaceChanges3D, HalvesOfCurvesHaveSpans)
{
  Box<3> box;
  const auto kept = keepEdgesOfTheCube(box);
  ASSERT_EQ(kept.size(), 12u * 4u);
  for (const auto& [edge, cell] : box.surfaceEdges())
  {
    const auto mark = box.editor.begin();
    const Index m = box.editor.addPoint(0.5 * (box.mesh.point(edge[0]) + box.mesh.point(edge[1])));
    ASSERT_TRUE(proposeSplit<3>(box.editor, &box.surface, cell, edge[0], edge[1], m, box.proposal));
    box.check();
    const auto spans = edgesOf(box.surface.changes[0].spans);
    std::set<std::array<Index, 2>> halves;
    if (kept.count(edge) > 0)
    {
      halves = { sortedIds(edge[0], m), sortedIds(edge[1], m) };
    }
    EXPECT_EQ(spans, halves);
    box.surface.offCurves = { sortedIds(edge[1], m) };
    box.surface.changes.clear();
    EXPECT_EQ(box.changes.allowsReplacement(box.surface, box.mesh, box.proposal), halves.empty());
    EXPECT_EQ(box.surface.changes.size(), halves.empty() ? 1u : 0u);
    box.surface.offCurves.clear();
    box.editor.rollback(mark);
  }
}

TEST(SurfaceChanges3D, CurvesOfNodesThatSlideHaveSpans)
{
  Box<3> box;
  const auto kept = keepEdgesOfTheCube(box);
  for (Index v = 0; v < box.mesh.numberOfPointSlots(); ++v)
  {
    std::set<std::array<Index, 2>> here;
    for (const auto& edge : kept)
    {
      if (hasId(edge, v))
      {
        here.insert(edge);
      }
    }
    box.proposal.clear();
    box.mesh.star(v, box.proposal.cavity);
    for (const Freedom freedom : { Freedom::Curve, Freedom::Fixed })
    {
      box.proposal.moves = { { v, box.mesh.point(v), { freedom, 0, 0.0 } } };
      box.surface.changes.clear();
      box.changes.beforeMoves(box.surface, box.mesh, box.proposal);
      EXPECT_TRUE(box.changes.allowsMoves(box.surface, box.mesh, box.proposal));
      ASSERT_EQ(box.surface.changes.size(), 1u);
      EXPECT_EQ(edgesOf(box.surface.changes[0].spans),
        freedom == Freedom::Curve ? here : (std::set<std::array<Index, 2>>()));
    }
    if (!here.empty())
    {
      box.proposal.moves[0].place.freedom = Freedom::Curve;
      box.surface.offCurves = { *here.rbegin() };
      box.surface.changes.clear();
      box.changes.beforeMoves(box.surface, box.mesh, box.proposal);
      EXPECT_FALSE(box.changes.allowsMoves(box.surface, box.mesh, box.proposal));
      EXPECT_TRUE(box.surface.changes.empty());
      box.surface.offCurves.clear();
    }
  }
}

// ---- angles (3D) --------------------------------------------------------------------------------

namespace
{
/// The cosines between the facets of the surface at each edge: in each region there are two of
/// them, and at the ends of an interface two outer ones.
struct Cosines
{
  std::multimap<std::array<Index, 2>, double> inside, outside;
};

Cosines cosinesOf(const Box<3>& box)
{
  std::map<std::pair<std::array<Index, 2>, Index>, std::vector<Vec<3>>> normals; // by region
  std::map<std::array<Index, 2>, std::vector<Vec<3>>> outer;
  std::set<std::array<Index, 2>> atInterface;
  for (const auto& entry : box.sides())
  {
    for (const Side<3>& side : entry.second)
    {
      const Vec<3> a = box.mesh.point(side.facet[0]);
      const Vec<3> n =
        (box.mesh.point(side.facet[1]) - a).cross(box.mesh.point(side.facet[2]) - a).normalized();
      for (int k = 0; k < 3; ++k)
      {
        const auto edge = sortedIds(side.facet[k], side.facet[(k + 1) % 3]);
        normals[{ edge, side.region }].push_back(n);
        if (entry.second.size() == 1)
        {
          outer[edge].push_back(n);
        }
        else
        {
          atInterface.insert(edge);
        }
      }
    }
  }
  Cosines result;
  for (const auto& [key, two] : normals)
  {
    EXPECT_EQ(two.size(), 2u);
    result.inside.emplace(key.first, two[0].dot(two[1]));
  }
  for (const auto& [edge, two] : outer)
  {
    EXPECT_EQ(two.size(), 2u);
    if (atInterface.count(edge) > 0)
    {
      result.outside.emplace(edge, two[0].dot(two[1]));
    }
  }
  return result;
}

/// Each angle asked for is one of the mesh, and each of the mesh has been asked for.
void expectAngles(const std::vector<Recorder<3>::Angle>& asked,
  const std::multimap<std::array<Index, 2>, double>& all,
  const std::set<std::array<Index, 2>>& kept)
{
  const auto isThat = [](const Recorder<3>::Angle& angle, const auto& entry)
  { return angle.edge == entry.first && std::fabs(angle.cosine - entry.second) < 1e-12; };
  for (const auto& angle : asked)
  {
    EXPECT_TRUE(
      std::any_of(all.begin(), all.end(), [&](const auto& entry) { return isThat(angle, entry); }));
    EXPECT_TRUE(kept.empty() || angle.isKept == (kept.count(angle.edge) > 0));
  }
  for (const auto& entry : all)
  {
    EXPECT_TRUE(std::any_of(
      asked.begin(), asked.end(), [&](const auto& angle) { return isThat(angle, entry); }))
      << entry.first[0] << " " << entry.first[1];
  }
}
}

TEST(SurfaceChanges3D, AllAnglesAtTheCellsAreAskedFor)
{
  Box<3> box;
  const auto kept = keepEdgesOfTheCube(box);
  TestRandom random(2);
  for (Index p = 0; p < box.mesh.numberOfPointSlots(); ++p) // no two angles are the same
  {
    box.editor.movePoint(p, box.mesh.point(p) + 0.03 * Vec<3>(random(), random(), random()));
  }
  std::vector<Index> cells;
  for (Index c = 0; c < box.mesh.numberOfCellSlots(); ++c)
  {
    cells.push_back(c);
  }
  EXPECT_TRUE(box.changes.allowsAngles(box.surface, box.mesh, cells));
  const Cosines all = cosinesOf(box);
  EXPECT_EQ(all.outside.size(), 4u * 4u); // the interface ends at a square of 4 edges a side
  expectAngles(box.surface.angles, all.inside, kept);
  expectAngles(box.surface.anglesOutside, all.outside, {});

  // Refused if one of them is.
  double least = 2.0, leastOutside = 2.0;
  for (const auto& entry : all.inside)
  {
    least = std::min(least, entry.second);
  }
  for (const auto& entry : all.outside)
  {
    leastOutside = std::min(leastOutside, entry.second);
  }
  ASSERT_GT(leastOutside, least); // at the edges of the cube angles are 90 degrees
  for (const double limit : { least - 1e-9, least + 1e-9 })
  {
    box.surface.leastCosine = limit;
    EXPECT_EQ(box.changes.allowsAngles(box.surface, box.mesh, cells), limit < least);
  }
}

/// Facets that must not change are not asked from; those beside them are.
TEST(SurfaceChanges3D, AnglesAtFacetsWithoutAPatch)
{
  Box<3> box;
  for (Index c = 0; c < box.mesh.numberOfCellSlots(); ++c)
  {
    for (int i = 0; i < 4; ++i)
    {
      if (box.mesh.isKept(c, i) && box.mesh.patch(c, i) != 0)
      {
        box.editor.setPatch(c, i, None);
      }
    }
  }
  std::vector<Index> cells;
  for (Index c = 0; c < box.mesh.numberOfCellSlots(); ++c)
  {
    cells.push_back(c);
  }
  EXPECT_TRUE(box.changes.allowsAngles(box.surface, box.mesh, cells));
  std::set<std::array<Index, 2>> asked, expected;
  for (const auto& angle : box.surface.angles)
  {
    asked.insert(angle.edge);
  }
  for (const auto& entry : box.surfaceEdges())
  {
    const auto& edge = entry.first;
    if (box.mesh.point(edge[0])[0] == 0.0 && box.mesh.point(edge[1])[0] == 0.0) // patch 0
    {
      expected.insert(edge);
    }
  }
  EXPECT_EQ(asked, expected);
}
