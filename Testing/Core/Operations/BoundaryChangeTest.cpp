// SPDX-License-Identifier: BSD-3-Clause
// What the boundary takes part in: its nodes slide, go and come where the result is known.
#include "Operations/BoundaryChange.h"
#include "PlaneMeshes.h"
#include "SlidingBoxes.h"
#include "TestBench.h"

using namespace meshopt;

namespace
{
using Change = BoundaryChange<2, MeanEdgeShape<2>>;

/// A mesh of the plane whose boundary is its curves.
struct Plane
{
  explicit Plane(const MeshInput<2>& in)
    : bench(in, &this->curves)
  {
    this->curves.build(this->bench.editor, CurveOptions());
  }
  bool improve(Index t, int level)
  {
    this->bench.judge.start();
    return this->change.improve(this->bench.judge, t, level);
  }
  /// The change must keep the area and the curves, and undoing it restore every bit; then it stays.
  void doUndoAndDo(Index t, int level)
  {
    const Snapshot<2> before(this->bench.editor);
    const double area = this->bench.mesh.volume();
    const auto mark = this->bench.judge.begin();
    ASSERT_TRUE(this->improve(t, level));
    EXPECT_FALSE(Snapshot<2>(this->bench.editor) == before);
    this->bench.judge.rollback(mark);
    EXPECT_TRUE(Snapshot<2>(this->bench.editor) == before);
    ASSERT_TRUE(this->improve(t, level));
    EXPECT_NEAR(this->bench.mesh.volume(), area, 1e-14);
    expectSound(this->bench.mesh);
    expectOnCurves(this->bench.mesh, this->curves, 1e-12);
  }

  BoundaryCurves curves;
  Bench<2> bench;
  Change change;
};

/// Half a regular hexagon; its straight side has a node at x. At 0 all three triangles are regular.
MeshInput<2> halfHexagon(double x)
{
  const double h = std::sqrt(0.75);
  MeshInput<2> in;
  in.points = { { x, 0 }, { 1, 0 }, { 0.5, h }, { -0.5, h }, { -1, 0 } };
  in.cells = { { 0, 1, 2 }, { 0, 2, 3 }, { 0, 3, 4 } };
  return in;
}

/// A regular triangle with a node on its base at x, -1/2 < x < 1/2.
MeshInput<2> dividedTriangle(double x)
{
  MeshInput<2> in;
  in.points = { { x, 0 }, { 0.5, 0 }, { 0, std::sqrt(0.75) }, { -0.5, 0 } };
  in.cells = { { 0, 1, 2 }, { 0, 2, 3 } };
  return in;
}

/// A flat triangle on a long side, below another one: (0, 1) can be divided.
MeshInput<2> flatTriangle()
{
  MeshInput<2> in;
  in.points = { { -1, 0 }, { 1, 0 }, { 0.2, 0.3 }, { 0, 3 } };
  in.cells = { { 0, 1, 2 }, { 1, 3, 2 }, { 3, 0, 2 } };
  return in;
}

double shape(const Vec<2>& a, const Vec<2>& b, const Vec<2>& c)
{
  return MeanEdgeShape<2>::value({ a, b, c });
}
}

TEST(BoundaryChange, ANodeSlidesToItsBestPlace)
{
  for (double x : { 0.5, -0.3, 0.05 })
  {
    Plane plane(halfHexagon(x));
    ASSERT_EQ(plane.bench.mesh.freedom(0), Freedom::Curve);
    plane.doUndoAndDo(0, Level::Topology);
    // 14 steps of the golden section leave that power of 80 % of the range of 2
    const double golden = 0.5 * (std::sqrt(5.0) - 1.0);
    EXPECT_NEAR(plane.bench.mesh.point(0)[0], 0.0, 2 * 0.8 * std::pow(golden, 14));
    EXPECT_EQ(plane.bench.mesh.point(0)[1], 0.0);
    EXPECT_GT(plane.bench.worst(), 0.999);
    EXPECT_EQ(triedOf(plane.bench.judge.done, Operation::NodeMotion), 1); // done, undone, done
    EXPECT_EQ(plane.bench.judge.changed().size(), 3u);
  }
}

TEST(BoundaryChange, ANodeAtItsBestPlaceStays)
{
  Plane plane(halfHexagon(0.0));
  for (Index t = 0; t < 3; ++t)
  {
    expectRefused(plane.bench, [&] { return plane.improve(t, Level::LongLookAhead); });
  }
  EXPECT_GT(triedOf(plane.bench.judge.tried, Operation::NodeMotion), 0);
  EXPECT_EQ(triedOf(plane.bench.judge.done, Operation::NodeMotion), 0);
}

TEST(BoundaryChange, InSpaceWhatFailedIsTriedAgainOnlyWhenTheStarHasChanged)
{
  SlidingSurface surface;
  Bench<3> b(slidingBox(2, 0.2), &surface);
  surface.build(b.editor, SurfaceOptions());
  BoundaryChange<3, MeanEdgeShape<3>> change;
  b.editor.stamp({ 0 }); // nothing counts at time 0
  const auto tries = [&]
  {
    const auto count = [&]
    {
      return triedOf(b.judge.tried, Operation::NodeMotion) +
        triedOf(b.judge.tried, Operation::EdgeContraction);
    };
    const long before = count();
    b.judge.start();
    const bool helped = change.improve(b.judge, 0, Level::Removal);
    return helped ? -1 : count() - before;
  };
  b.judge.setGain(1.0); // too much
  const long first = tries();
  ASSERT_GT(first, 0);
  EXPECT_EQ(tries(), 0);
  b.editor.stamp({ 0 });
  EXPECT_EQ(tries(), first);
}

TEST(BoundaryChange, ANodeTooManyGoes)
{
  Plane plane(dividedTriangle(0.1));
  expectRefused(plane.bench, // its best place is no better; and nodes go at a higher level only
    [&]
    {
      plane.bench.switches.moveNodes = false;
      return plane.improve(0, Level::Topology);
    });
  plane.doUndoAndDo(0, Level::Insertion);
  EXPECT_EQ(plane.bench.mesh.countCells(), 1);
  EXPECT_NEAR(plane.bench.worst(), 1.0, 1e-14); // the regular triangle
  EXPECT_FALSE(plane.bench.mesh.isPointAlive(0));
  EXPECT_EQ(plane.bench.judge.growth.left, AnyGrowth + 1);
  EXPECT_EQ(triedOf(plane.bench.judge.done, Operation::EdgeContraction), 1); // done, undone, done
}

TEST(BoundaryChange, ALongSideIsDividedWhereThatIsBest)
{
  Plane plane(flatTriangle());
  Bench<2>& b = plane.bench;
  b.switches.moveNodes = b.switches.removeNodes = false;
  const Vec<2> low = b.mesh.point(0), high = b.mesh.point(1), top = b.mesh.point(2);
  double best = 0.0, at = 0.0; // all places on the side
  for (int k = 1; k < 10000; ++k)
  {
    const Vec<2> x = low + k * 1e-4 * (high - low);
    const double q = std::min(shape(low, x, top), shape(x, high, top));
    at = q > best ? x[0] : at;
    best = std::max(best, q);
  }
  ASSERT_GT(best, b.judge.required(b.mesh.quality(0)));
  expectRefused(b, [&] { return plane.improve(0, Level::Topology); });
  EXPECT_FALSE(b.judge.growth.isShort);
  b.judge.growth.left = 1; // it comes one cell; room for two is asked for
  expectRefused(b, [&] { return plane.improve(0, Level::Insertion); });
  EXPECT_TRUE(b.judge.growth.isShort); // so that a run can say why it stops
  b.judge.growth.left = 2;
  plane.doUndoAndDo(0, Level::Insertion);
  EXPECT_EQ(b.judge.growth.left, 1);
  EXPECT_EQ(b.mesh.countCells(), 4);
  EXPECT_EQ(triedOf(b.judge.done, Operation::NodeInsertion), 1); // done, undone, done
  const Index p = b.mesh.numberOfPointSlots() - 1;
  EXPECT_EQ(b.mesh.freedom(p), Freedom::Curve);
  EXPECT_EQ(b.mesh.point(p)[1], 0.0);
  EXPECT_NEAR(b.mesh.point(p)[0], at, 0.01);
  for (Index c : b.editor.created())
  {
    EXPECT_GT(b.mesh.quality(c), best - 1e-3);
  }
}

TEST(BoundaryChange, SwitchesTurnKindsOff)
{
  Plane sliding(halfHexagon(0.5));
  sliding.bench.switches.moveNodes = sliding.bench.switches.insertNodes = false;
  sliding.bench.switches.removeNodes = false;
  expectRefused(sliding.bench, [&] { return sliding.improve(0, Level::LongLookAhead); });
  Plane going(dividedTriangle(0.1));
  going.bench.switches.removeNodes = going.bench.switches.moveNodes = false;
  going.bench.switches.insertNodes = false;
  expectRefused(going.bench, [&] { return going.improve(0, Level::LongLookAhead); });
  Plane dividing(flatTriangle());
  dividing.bench.switches.insertNodes = dividing.bench.switches.moveNodes = false;
  dividing.bench.switches.removeNodes = false;
  expectRefused(dividing.bench, [&] { return dividing.improve(0, Level::LongLookAhead); });
}

TEST(BoundaryChange, WithoutASurfaceOrWhatIsOwnedNothingHappens)
{
  Bench<2> kept(halfHexagon(0.5));
  Change change;
  expectRefused(kept, [&] { return change.improve(kept.judge, 0, Level::LongLookAhead); });
  Plane away(halfHexagon(0.5));
  away.bench.giveAway({ 4 });
  expectRefused(away.bench, [&] { return away.improve(0, Level::LongLookAhead); });
  EXPECT_TRUE(away.bench.editor.isHeldUp());
}
