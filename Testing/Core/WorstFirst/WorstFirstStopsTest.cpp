// SPDX-License-Identifier: BSD-3-Clause
// The fast engine as a whole: what it may do, and why it stops.
#include "CappedCell.h"
#include "WorstFirstRuns.h"

#include <set>

using namespace meshopt;

template <class T>
class WorstFirstStops : public ::testing::Test
{
};
TYPED_TEST_SUITE(WorstFirstStops, TestDimensions);

// ---- options ------------------------------------------------------------------------------------

TYPED_TEST(WorstFirstStops, KindsOfOperationsCanBeSwitchedOff)
{
  constexpr int D = TypeParam::dimension;
  const MeshInput<D> in = testMesh<D>(0.32, 2);
  for (int off = 0; off < 5; ++off) // 4: nothing is off
  {
    Options options = target(0.9); // beyond reach: all is tried
    options.effort = off == 4 ? Effort::Quick : Effort::Default;
    options.moveNodes = off != 0;
    options.reconnect = off != 1;
    options.insertNodes = off != 2;
    options.removeNodes = off != 3;
    SimplexMesh<D> mesh = buildMesh(in);
    const Report report = run<D>(mesh, options);
    EXPECT_EQ(count(report, Operation::NodeMotion) == 0, off == 0) << off;
    EXPECT_EQ(count(report, Operation::EdgeRemoval) == 0, off == 1) << off;
    EXPECT_TRUE(off != 1 || count(report, Operation::FaceRemoval) == 0);
    EXPECT_EQ(count(report, Operation::NodeInsertion) == 0, off == 2) << off;
    EXPECT_TRUE(off != 2 || count(report, Operation::LookAhead) == 0);
    EXPECT_TRUE(off != 3 || count(report, Operation::EdgeContraction) == 0);
    Index moved = 0, gone = 0;
    for (Index p = 0; p < mesh.numberOfInputPoints(); ++p)
    {
      gone += !mesh.isPointAlive(p);
      moved += mesh.isPointAlive(p) && mesh.point(p) != in.points[p];
    }
    EXPECT_EQ(moved == 0, off == 0) << off;
    EXPECT_TRUE(off != 2 || mesh.countPoints() <= mesh.numberOfInputPoints());
    EXPECT_TRUE(off != 3 || gone == 0) << gone << " points are gone";
  }
}

/// A finely divided cube's surface, all joined to one node: it takes many more nodes to make that
/// good.
MeshInput<3> conedCube(const Vec<3>& apex)
{
  const SimplexMesh<3> cube = buildMesh(jitteredGrid<3>(8, 0.0));
  MeshInput<3> in;
  for (Index p = 0; p < cube.numberOfPointSlots(); ++p)
  {
    in.points.push_back(cube.point(p));
  }
  in.points.push_back(apex);
  for (Index c = 0; c < cube.numberOfCellSlots(); ++c)
  {
    for (int i = 0; i < 4; ++i)
    {
      if (cube.isKept(c, i))
      {
        const Facet<3> f = cube.facet(c, i);
        in.cells.push_back({ f[0], f[1], f[2], static_cast<Index>(in.points.size()) - 1 });
      }
    }
  }
  return in;
}

TYPED_TEST(WorstFirstStops, GrowthBudgetIsHonoured)
{
  constexpr int D = TypeParam::dimension;
  for (double jitter : { 0.32, 0.8 }) // the latter is tangled: it is untangled first
  {
    const MeshInput<D> in = testMesh<D>(jitter, 2);
    for (double budget : { 0.0, 0.02, 0.1 })
    {
      Options options = target(0.9);
      options.growthBudget = budget;
      options.effort = Effort::Quick;
      SimplexMesh<D> mesh = buildMesh(in);
      run<D>(mesh, options); // looks at the number of cells
    }
  }
}

TEST(WorstFirstStops3D, GrowthBudgetIsHonouredWhileUntangling)
{
  Options options = target(0.6);
  options.growthBudget = 0.05;
  SimplexMesh<3> mesh = buildMesh(conedCube(Vec<3>(0.5, 0.5, 1.3))); // the node is outside
  const Report report = run<3>(mesh, options);                       // looks at the number of cells
  EXPECT_GT(report.invertedBefore, 0);
}

// ---- why it stops -------------------------------------------------------------------------------

/// One cell whose fourth node is the best there is for its first facet: it has all that is allowed.
TEST(WorstFirstStops3D, StopsWhereTheSurfaceCaps)
{
  const MeshInput<3> in = cellAtItsCap();
  const double cap = facetCap(in.points[0], in.points[1], in.points[2]);
  for (Effort effort : { Effort::Quick, Effort::Default, Effort::Best })
  {
    SimplexMesh<3> mesh = buildMesh(in);
    const MeshBits<3> before = bitsOf(mesh);
    Options options = target(cap + 0.1);
    options.effort = effort;
    const Report report = run<3>(mesh, options);
    EXPECT_EQ(report.stopReason, StopReason::CappedBySurface);
    EXPECT_EQ(report.cappedCells, 1);
    EXPECT_NEAR(report.bound, cap, 1e-6);
    EXPECT_NEAR(report.worstAfter, cap, 1e-12);
    EXPECT_EQ(bitsOf(mesh), before);
  }
}

/// The same among many cells that reach the target: a point of a cube's surface lies close to an
/// edge, which leaves a facet like (0, 0), (.3, 0), (1, 1). Its cap is .347; all others allow more.
TEST(WorstFirstStops3D, StopsOnceAllButTheCappedAreGood)
{
  constexpr double goal = 0.4;
  MeshInput<3> in = jitteredGrid<3>(4, 0.2);
  *std::find(in.points.begin(), in.points.end(), Vec<3>(0.25, 0.5, 0.0)) = { 0.075, 0.5, 0.0 };
  SimplexMesh<3> mesh = buildMesh(in);
  const double cap = facetCap({ 0, 0, 0 }, { 0.3, 0, 0 }, { 1, 1, 0 });
  const Report report = run<3>(mesh, target(goal));
  EXPECT_EQ(report.stopReason, StopReason::CappedBySurface);
  EXPECT_NEAR(report.bound, cap, 1e-6);
  EXPECT_GT(report.worstAfter, 0.99 * cap);
  const std::vector<double> qualities = sortedQualities(mesh);
  const long below = std::lower_bound(qualities.begin(), qualities.end(), goal) - qualities.begin();
  EXPECT_EQ(below, 1);
  EXPECT_EQ(report.cappedCells, below);
  EXPECT_EQ(report.history.back().belowTarget, below);
}

TEST(WorstFirstStops3D, SaysWhereTheGrowthBudgetIsUsedUp)
{
  const MeshInput<3> in = conedCube(Vec<3>::Constant(0.5));
  Options options = target(0.6);
  options.growthBudget = 0.1;
  SimplexMesh<3> tight = buildMesh(in), roomy = buildMesh(in);
  const Report little = run<3>(tight, options);
  EXPECT_EQ(little.stopReason, StopReason::GrowthLimit) << little.worstAfter;
  options.growthBudget = 4.0;
  const Report much = run<3>(roomy, options);
  EXPECT_NE(much.stopReason, StopReason::GrowthLimit);
  EXPECT_GT(much.worstAfter, little.worstAfter + 0.1);
}

/// Nothing may change, and some of the cells under the target have no kept facet to cap them.
TYPED_TEST(WorstFirstStops, StopsWithoutFurtherGain)
{
  constexpr int D = TypeParam::dimension;
  MeshInput<D> in = jitteredGrid<D>(4, 0.2);
  in.fixedPoints.assign(in.points.size(), 1);
  Options options = target(0.99);
  options.reconnect = options.insertNodes = options.removeNodes = false;
  SimplexMesh<D> mesh = buildMesh(in);
  const MeshBits<D> before = bitsOf(mesh);
  const Report report = run<D>(mesh, options);
  EXPECT_EQ(bitsOf(mesh), before);
  EXPECT_EQ(report.stopReason, StopReason::NoFurtherGain);
  EXPECT_LT(report.cappedCells, report.history.back().belowTarget);
}

TYPED_TEST(WorstFirstStops, StopsAtTheTarget)
{
  constexpr int D = TypeParam::dimension;
  SimplexMesh<D> mesh = buildMesh(testMesh<D>());
  const double goal = D == 3 ? 0.4 : 0.6;
  const Report report = run<D>(mesh, target(goal));
  EXPECT_EQ(report.stopReason, StopReason::TargetReached);
  EXPECT_LT(report.worstBefore, goal);
  EXPECT_GE(report.worstAfter, goal);
  SimplexMesh<D> good = buildMesh(jitteredGrid<D>(3, 0.0)); // it has been there before
  const MeshBits<D> before = bitsOf(good);
  const Report none = run<D>(good, target(0.3));
  EXPECT_EQ(none.stopReason, StopReason::TargetReached);
  EXPECT_EQ(bitsOf(good), before);
}

TYPED_TEST(WorstFirstStops, CanBeAborted)
{
  constexpr int D = TypeParam::dimension;
  SimplexMesh<D> mesh = buildMesh(testMesh<D>());
  int calls = 0;
  double last = 0.0;
  Control control;
  control.progress = [&](double fraction, const std::string& text)
  {
    EXPECT_GE(fraction, last);
    EXPECT_LE(fraction, 1.0);
    EXPECT_FALSE(text.empty());
    last = fraction;
    return ++calls < 1;
  };
  const Report report = run<D>(mesh, target(0.9), control);
  EXPECT_EQ(report.stopReason, StopReason::Aborted);
  EXPECT_EQ(calls, 1); // not asked again
}

/// A limit that is over before the first change: none is made. Sound is what every run() checks.
TYPED_TEST(WorstFirstStops, KeepsItsTimeLimit)
{
  constexpr int D = TypeParam::dimension;
  for (double jitter : { 0.25, 0.8 }) // the latter is tangled: time is over in the untangling
  {
    SimplexMesh<D> mesh = buildMesh(testMesh<D>(jitter));
    const MeshBits<D> before = bitsOf(mesh);
    Control control;
    control.deadline = std::chrono::steady_clock::now();
    const Report report = run<D>(mesh, target(0.95), control);
    EXPECT_EQ(report.stopReason, StopReason::TimeLimit);
    EXPECT_EQ(bitsOf(mesh), before);
  }
}

// ---- parts of a mesh ----------------------------------------------------------------------------

/// A part whose border is so bad that the certified bound of the part is far below the target.
TEST(WorstFirstStops, BestGoesPastTheTargetBesideABadBorder)
{
  MeshInput<3> in = testMesh<3>(0.25, 3);
  const double side = in.points.back()[0];
  in.borderPoints.assign(in.points.size(), 0);
  for (std::size_t p = 0; p < in.points.size(); ++p)
  {
    in.borderPoints[p] = in.points[p][0] == 0.0;
  }
  // One of its nodes nearly on the line between two neighbours: a needle that is kept.
  std::size_t inside = 0;
  while (in.points[inside][0] != 0.0 || in.points[inside][1] == 0.0 ||
    in.points[inside][2] == 0.0 || in.points[inside][1] == side || in.points[inside][2] == side)
  {
    ++inside;
  }
  in.points[inside][1] *= 0.1;
  Options options = target(0.5);
  options.effort = Effort::Best;
  // Of cells that share no node with one at the border: those may pay for its rise.
  const auto worstInside = [](const SimplexMesh<3>& mesh)
  {
    std::set<Index> beside;
    double worst = 1.0;
    for (const bool isSecond : { false, true })
    {
      for (Index c = 0; c < mesh.numberOfCellSlots(); ++c)
      {
        const auto& nodes = mesh.nodes(c);
        const bool isLeft = std::any_of(nodes.begin(), nodes.end(),
          [&](Index p) { return isSecond ? beside.count(p) > 0 : mesh.isAtBorder(p); });
        if (mesh.isAlive(c) && isLeft && !isSecond)
        {
          beside.insert(nodes.begin(), nodes.end());
        }
        worst = mesh.isAlive(c) && !isLeft && isSecond ? std::min(worst, mesh.quality(c)) : worst;
      }
    }
    return worst;
  };
  SimplexMesh<3> whole = buildMesh(in), part = whole;
  EXPECT_TRUE(part.hasBorder());
  const Report report = run<3>(whole, options);
  EXPECT_LT(report.bound, 0.5);
  options.mostQuality = 1.0;
  run<3>(part, options);
  EXPECT_GT(worstInside(part), worstInside(whole));
  EXPECT_GT(worstInside(part), 0.55);
}
