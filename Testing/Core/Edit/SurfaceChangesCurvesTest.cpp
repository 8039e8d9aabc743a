// SPDX-License-Identifier: BSD-3-Clause
// The curves of a surface that a change concerns, and the angles that it makes, against a search of
// the whole mesh.
#include "SurfaceChangesTesting.h"

using namespace meshopt;

// ---- curves ------------------------------------------------------------------------------------

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
    ASSERT_TRUE(
      proposeSplit<3>(box.editor, &box.surface, { cell, edge[0], edge[1], m }, box.proposal));
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

// ---- angles ------------------------------------------------------------------------------------

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
