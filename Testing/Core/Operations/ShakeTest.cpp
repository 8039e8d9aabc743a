// SPDX-License-Identifier: BSD-3-Clause
// Nodes around a cell are moved by chance: on their surface, the same way each time, and undone to
// the bit.
#include "Operations/Shake.h"
#include "SlidingBoxes.h"

using namespace meshopt;

namespace
{
using Shaking = Shake<3, MeanEdgeShape<3>>;

/// A cube whose faces and edges take part.
struct Box : Sliding
{
  Box()
    : Sliding(slidingBox(4, 0.2), {})
    , model(this->mesh, this->metric, 0.0)
    , judge(this->editor, this->model, this->switches, &this->surface)
  {
    for (Index c = 0; c < this->mesh.numberOfCellSlots(); ++c)
    {
      this->editor.setQuality(c, this->model(this->mesh.nodes(c)));
    }
  }

  NodalMetric<3> metric;
  QualityModel<3, MeanEdgeShape<3>> model;
  Switches switches;
  Judge<3, MeanEdgeShape<3>> judge;
};

std::vector<Vec<3>> pointsOf(const SimplexMesh<3>& mesh)
{
  std::vector<Vec<3>> points;
  for (Index p = 0; p < mesh.numberOfPointSlots(); ++p)
  {
    points.push_back(mesh.point(p));
  }
  return points;
}
}

TEST(Shake, MovesNodesOfTheSurfaceOnIt)
{
  Box b;
  Shaking shake;
  const SimplexMesh<3> before = b.mesh;
  const double volume = b.mesh.volume();
  std::array<int, NumberOfFreedoms> moved{};
  for (Index t = 0; t < b.mesh.numberOfCellSlots(); ++t)
  {
    b.judge.start();
    shake.move(b.judge, t, t, 0.2);
  }
  for (Index p = 0; p < b.mesh.numberOfPointSlots(); ++p)
  {
    moved[static_cast<int>(b.mesh.freedom(p))] += b.mesh.point(p) != before.point(p);
  }
  EXPECT_GT(moved[static_cast<int>(Freedom::Free)], 20);
  EXPECT_GT(moved[static_cast<int>(Freedom::Patch)], 20);
  EXPECT_GT(moved[static_cast<int>(Freedom::Curve)], 10);
  EXPECT_EQ(moved[static_cast<int>(Freedom::Corner)], 0);
  EXPECT_EQ(moved[static_cast<int>(Freedom::Fixed)], 0);
  EXPECT_GE(sortedQualities(b.mesh).front(), 0.2);
  expectSound(b.mesh);
  EXPECT_NEAR(b.mesh.volume(), volume, 1e-12); // the faces are flat and the edges straight
}

TEST(Shake, IsTheSameEachTimeAndUndone)
{
  Box b;
  Shaking shake, other;
  const Index t = cellNear<3>(b.mesh, Vec<3>(0.1, 0.5, 0.5));
  const Snapshot<3> before(b.editor);
  auto mark = b.judge.begin();
  b.judge.start();
  ASSERT_TRUE(shake.move(b.judge, t, 0, 0.1));
  const std::vector<Vec<3>> first = pointsOf(b.mesh);
  b.judge.rollback(mark);
  EXPECT_TRUE(Snapshot<3>(b.editor) == before);
  mark = b.judge.begin();
  b.judge.start();
  ASSERT_TRUE(shake.move(b.judge, t, 1, 0.1));
  EXPECT_NE(pointsOf(b.mesh), first);
  b.judge.rollback(mark);
  b.judge.start();
  ASSERT_TRUE(other.move(b.judge, t, 0, 0.1));
  EXPECT_EQ(pointsOf(b.mesh), first);
}

TEST(Shake, SaysWhatItHasChanged)
{
  Box b;
  Shaking shake;
  const Index t = cellNear<3>(b.mesh, Vec<3>(0.1, 0.5, 0.5));
  const SimplexMesh<3> before = b.mesh;
  b.judge.start();
  ASSERT_TRUE(shake.move(b.judge, t, 3, 0.1));
  const std::vector<Index>& changed = b.judge.changed();
  EXPECT_TRUE(std::binary_search(changed.begin(), changed.end(), t));
  for (Index c = 0; c < b.mesh.numberOfCellSlots(); ++c)
  {
    EXPECT_TRUE(b.mesh.quality(c) == before.quality(c) ||
      std::binary_search(changed.begin(), changed.end(), c));
  }
}

TEST(Shake, LeavesWhatWouldBecomeWorseThanAllowed)
{
  Box b;
  Shaking shake;
  const Snapshot<3> before(b.editor);
  b.judge.start();
  EXPECT_FALSE(shake.move(b.judge, cellNear<3>(b.mesh, Vec<3>(0.5, 0.5, 0.5)), 0, 1.0));
  EXPECT_TRUE(Snapshot<3>(b.editor) == before);
}
