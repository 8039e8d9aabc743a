// SPDX-License-Identifier: BSD-3-Clause
// Where a surface that has changed passes through itself, and that nothing changes there any more.
#include "Surface/NewCrossings.h"

#include "Mesh/Ids.h"
#include "SlidingBoxes.h"

using namespace meshopt;

namespace
{
/// Two tetrahedra, one over the other, with a gap between the tip of the lower one, at this height,
/// and the base of the upper one at 1.
SimplexMesh<3> underRoof(double tip)
{
  MeshInput<3> in;
  in.points = { { 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, { 0.3, 0.3, tip }, { 0, 0, 1 }, { 1, 0, 1 },
    { 0, 1, 1 }, { 0.3, 0.3, 2 } };
  in.cells = { { 0, 1, 2, 3 }, { 4, 5, 6, 7 } };
  return buildMesh(in);
}

TEST(NewCrossings, ATipThatPassesThroughARoof)
{
  const SimplexMesh<3> before = underRoof(0.5), now = underRoof(1.2);
  const std::vector<BoxTree::Box> boxes = findNewCrossings(before, now);
  ASSERT_FALSE(boxes.empty());
  BoxTree::Box all;
  for (const BoxTree::Box& box : boxes)
  {
    all.extend(box);
  }
  EXPECT_EQ(
    all.min(), Eigen::Vector3d(0, 0, 0)); // the sides of the tip, and what they pass through
  EXPECT_EQ(all.max(), Eigen::Vector3d(1, 1, 1.2));
  EXPECT_FALSE(findNewCrossings(now, underRoof(1.3)).empty()); // it passes again
}

TEST(NewCrossings, WhatTouchesOrWasThereIsNone)
{
  EXPECT_TRUE(findNewCrossings(underRoof(0.5), underRoof(0.9)).empty());
  EXPECT_TRUE(findNewCrossings(underRoof(0.5), underRoof(1.0)).empty());
  EXPECT_TRUE(findNewCrossings(underRoof(1.2), underRoof(1.2)).empty());
}

/// A facet of the surface with a node at x, and the same in halves.
SurfaceChange<3> halvedAt(const SimplexMesh<3>& mesh, const Vec<3>& x)
{
  SurfaceChange<3> change;
  for (Index c = 0; c < mesh.numberOfCellSlots(); ++c)
  {
    for (int i = 0; i < 4 && change.gone.empty(); ++i)
    {
      const Facet<3> f = mesh.facet(c, i);
      if (mesh.isKept(c, i) &&
        std::any_of(f.begin(), f.end(), [&](Index p) { return mesh.point(p) == x; }))
      {
        SurfacePiece<3> piece;
        std::transform(f.begin(), f.end(), piece.x.begin(), [&](Index p) { return mesh.point(p); });
        piece.patch = mesh.patch(c, i);
        piece.region = mesh.region(c);
        change.gone.push_back(piece);
        change.come = { piece, piece };
        for (int k : { 0, 1 })
        {
          change.come[k].x[k] = 0.5 * (piece.x[0] + piece.x[1]);
        }
      }
    }
  }
  return change;
}

TEST(NewCrossings, ASurfaceDoesNotChangeThereAnyMore)
{
  const MeshInput<3> in = jitteredGrid<3>(4, 0.0);
  MeshInput<3> pressed = in;
  *std::find(
    pressed.points.begin(), pressed.points.end(), Vec<3>(0.5, 0.5, 1.0)) = { 0.51, 0.52, -0.2 };
  SurfaceOptions options;
  options.tolerance = 1e-2;
  Sliding box(in, options);
  const SurfaceChange<3> there = halvedAt(box.mesh, { 0.5, 0.5, 1.0 });
  const SurfaceChange<3> away = halvedAt(box.mesh, { 0.0, 0.5, 0.5 });
  ASSERT_EQ(there.gone.size() + away.gone.size(), 2u);
  EXPECT_FALSE(box.surface.refuseCrossings(box.mesh, box.mesh));
  EXPECT_TRUE(box.surface.allows(there));
  EXPECT_TRUE(box.surface.refuseCrossings(box.mesh, buildMesh(pressed)));
  EXPECT_FALSE(box.surface.allows(there));
  EXPECT_TRUE(box.surface.allows(away));
}

/// As soon as one place is refused, so are those that have always been there.
TEST(NewCrossings, PartsThatHaveAlwaysCrossedAreLeftAloneThen)
{
  MeshInput<3> in = jitteredGrid<3>(4, 0.0);
  const MeshInput<3> one = in;
  const auto n = static_cast<Index>(one.points.size());
  for (const Vec<3>& x : one.points) // another cube reaches into the first
  {
    in.points.push_back(x + Vec<3>(0.9, 0.0, 0.1));
  }
  for (const Simplex<3>& t : one.cells)
  {
    in.cells.push_back({ t[0] + n, t[1] + n, t[2] + n, t[3] + n });
  }
  MeshInput<3> pressed = in;
  *std::find(
    pressed.points.begin(), pressed.points.end(), Vec<3>(0.25, 0.5, 1.0)) = { 0.25, 0.5, -0.2 };
  SurfaceOptions options;
  options.tolerance = 1e-2;
  Sliding boxes(in, options);
  const SurfaceChange<3> crossed = halvedAt(boxes.mesh, { 1.0, 0.5, 0.5 });
  EXPECT_FALSE(boxes.surface.refuseCrossings(boxes.mesh, boxes.mesh));
  EXPECT_TRUE(boxes.surface.allows(crossed));
  EXPECT_TRUE(boxes.surface.refuseCrossings(boxes.mesh, buildMesh(pressed)));
  EXPECT_FALSE(boxes.surface.allows(crossed));
}
}
