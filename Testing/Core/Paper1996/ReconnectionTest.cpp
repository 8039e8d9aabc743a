// SPDX-License-Identifier: BSD-3-Clause
// The operations of the paper's figure 1, each on a case made by hand, and the iteration of 2.3.
#include "Paper1996/Reconnection.h"
#include "Run/Summary.h"
#include "TestMeshes.h"

#include <numeric>

using namespace meshopt;

namespace
{
template <int D>
ReconnectionResult run(SimplexMesh<D>& mesh, std::vector<Filling> kinds, int lookAhead = 0,
  const std::function<bool(double)>& keepGoing = {})
{
  NodalMetric<D> metric;
  MeshEditor<D> editor(mesh);
  computeQualities<D>(editor, metric, Measure::Shape, 0.0);
  ReconnectionParameters parameters;
  parameters.lookAhead = lookAhead;
  if (!kinds.empty())
  {
    parameters.allowed.fill(false);
    for (Filling kind : kinds)
    {
      parameters.allowed[static_cast<int>(kind)] = true;
    }
  }
  ReconnectionMemory<D> memory;
  return reconnect<D>({ editor, metric, Measure::Shape }, parameters, memory, keepGoing);
}

template <int D>
void expectDone(MeshInput<D> in, Filling kind, Index cellsAfter, Index pointsAfter)
{
  SimplexMesh<D> mesh = buildMesh(in);
  const double volume = mesh.volume();
  const auto kept = keptFacets(mesh);
  const long euler = eulerCharacteristic(mesh);
  const ReconnectionResult result = run<D>(mesh, { kind });
  EXPECT_GE(result.done[static_cast<int>(kind)], 1);
  EXPECT_EQ(mesh.countCells(), cellsAfter);
  EXPECT_EQ(mesh.countPoints(), pointsAfter);
  EXPECT_NEAR(mesh.volume(), volume, 1e-13);
  EXPECT_EQ(keptFacets(mesh), kept);
  EXPECT_EQ(eulerCharacteristic(mesh), euler);
  expectSound(mesh);
}

// n tetrahedra around the edge (0, 1) of half-length h; ring points 2 .. n + 1 on the unit circle.
MeshInput<3> ring(int n, double h)
{
  MeshInput<3> in;
  in.points = { { 0, 0, -h }, { 0, 0, h } };
  for (int k = 0; k < n; ++k)
  {
    const double a = 2.0 * M_PI * k / n;
    in.points.emplace_back(std::cos(a), std::sin(a), 0.0);
    in.cells.push_back({ 0, 1, 2 + k, 2 + (k + 1) % n });
  }
  return in;
}

// A hexagon (2D) or an icosahedron's points (3D) joined to a node that is far off the centre.
MeshInput<2> hexagon(const Vec<2>& centre)
{
  MeshInput<2> in;
  in.points.push_back(centre);
  for (int k = 0; k < 6; ++k)
  {
    in.points.emplace_back(std::cos(k * M_PI / 3.0), std::sin(k * M_PI / 3.0));
    in.cells.push_back({ 0, 1 + k, 1 + (k + 1) % 6 });
  }
  return in;
}

// A tetrahedron split in four by an inner node.
MeshInput<3> splitTetrahedron(const Vec<3>& centre)
{
  MeshInput<3> in;
  in.points = { { 1, 1, 1 }, { 1, -1, -1 }, { -1, 1, -1 }, { -1, -1, 1 }, centre };
  in.cells = { { 4, 1, 3, 2 }, { 0, 4, 3, 2 }, { 0, 1, 3, 4 }, { 0, 1, 4, 2 } };
  for (Simplex<3>& cell : in.cells)
  {
    Corners<3> x;
    for (int i = 0; i < 4; ++i)
    {
      x[i] = in.points[cell[i]];
    }
    if (signedVolume(x) < 0.0)
    {
      std::swap(cell[2], cell[3]);
    }
  }
  return in;
}
}

// ---- 2D: figure 1, interior ---------------------------------------------------------------------

TEST(Reconnection2D, EdgeToRingNodeIsASwap)
{
  MeshInput<2> in;
  in.points = { { -1, 0 }, { 1, 0 }, { 0, 0.3 }, { 0, -0.3 } };
  in.cells = { { 0, 1, 2 }, { 1, 0, 3 } };
  expectDone<2>(in, Filling::RingNode, 2, 4);
}

TEST(Reconnection2D, EdgeToMidpointIsASplit)
{
  MeshInput<2> in; // a long diamond whose swap would be worse still, with the long edge inside
  in.points = { { -1, 0 }, { 1, 0 }, { 0, 0.6 }, { 0, -0.6 } };
  in.cells = { { 0, 1, 2 }, { 1, 0, 3 } };
  expectDone<2>(in, Filling::Midpoint, 4, 5);
}

TEST(Reconnection2D, NodeToCentre) { expectDone<2>(hexagon({ 0.7, 0.1 }), Filling::Centre, 6, 7); }

TEST(Reconnection2D, NodeToBoundaryNodeIsARemoval)
{
  expectDone<2>(hexagon({ 0.8, 0.0 }), Filling::BoundaryNode, 4, 6);
}

// ---- 3D
// ------------------------------------------------------------------------------------------

TEST(Reconnection3D, EdgeToRingNodeRemovesTheEdge)
{
  for (int n = 3; n <= 6; ++n)
  {
    expectDone<3>(ring(n, n == 3 ? 1.5 : 0.1 * n + 2.0), Filling::RingNode, 2 * (n - 2), n + 2);
  }
}

TEST(Reconnection3D, EdgeToMidpointBisectsTheEdge)
{
  expectDone<3>(ring(4, 3.0), Filling::Midpoint, 8, 7);
}

TEST(Reconnection3D, NodeToCentre)
{
  expectDone<3>(splitTetrahedron({ 0.1, 0.5, 0.2 }), Filling::Centre, 4, 5);
}

TEST(Reconnection3D, NodeToBoundaryNodeIsAContraction)
{
  expectDone<3>(splitTetrahedron({ 0.0, 0.1, 0.0 }), Filling::BoundaryNode, 1, 4);
}

TEST(Reconnection3D, OpenRingExchangesTwoCellsForThree)
{
  MeshInput<3> in; // two flat tetrahedra on a large face: better as three around an edge
  in.points = { { 1, 0, 0 }, { -0.5, 0.87, 0 }, { -0.5, -0.87, 0 }, { 0, 0, 0.9 }, { 0, 0, -0.2 } };
  in.cells = { { 0, 1, 2, 3 }, { 0, 2, 1, 4 } };
  expectDone<3>(in, Filling::OpenRing, 3, 5);
}

TEST(Reconnection3D, CentreOfASurfaceNodesClusterIsANewNode)
{
  expectDone<3>(ring(4, 4.0), Filling::NewCentre, 8, 7);
}

// ---- what must be kept
// ---------------------------------------------------------------------------

TEST(Reconnection, InterfaceAndFixedNodesStay)
{
  MeshInput<3> two = ring(4, 3.0); // the edge lies between two regions
  two.regions = { 0, 0, 1, 1 };
  SimplexMesh<3> mesh = buildMesh(two);
  const auto kept = keptFacets(mesh);
  run<3>(mesh, {});
  EXPECT_EQ(keptFacets(mesh), kept);
  expectSound(mesh);

  MeshInput<2> fixed = hexagon({ 0.8, 0.0 });
  fixed.fixedPoints.assign(fixed.points.size(), 0);
  fixed.fixedPoints[0] = 1;
  SimplexMesh<2> flat = buildMesh(fixed);
  run<2>(flat, {});
  EXPECT_TRUE(flat.isPointAlive(0));
  EXPECT_EQ(flat.point(0), Vec<2>(0.8, 0.0));
  expectSound(flat);
}

TEST(Reconnection, KeptEdgeStays)
{
  MeshInput<3> in = ring(4, 3.0);
  in.keptEdges = { { 0, 1 } };
  SimplexMesh<3> mesh = buildMesh(in);
  run<3>(mesh, {});
  bool found = false;
  for (Index c = 0; c < mesh.numberOfCellSlots(); ++c)
  {
    found = found || (mesh.isAlive(c) && mesh.localIndex(c, 0) >= 0 && mesh.localIndex(c, 1) >= 0);
  }
  EXPECT_TRUE(found);
  expectSound(mesh);
}

// ---- the iteration
// -------------------------------------------------------------------------------

/// What is asked before each step, against a look at all elements: the worst one that is not set
/// aside; if all are, the worst one whose look-ahead has not failed since something changed.
template <int D>
class Order
{
public:
  Order(const SimplexMesh<D>& mesh, const ReconnectionMemory<D>& memory, int lookAhead)
    : mesh_(mesh)
    , memory_(memory)
    , lookAhead_(lookAhead)
  {
  }

  void expect(double asked, double target)
  {
    std::vector<std::pair<double, Index>> under;
    for (Index c = 0; c < this->mesh_.numberOfCellSlots(); ++c)
    {
      if (this->mesh_.isAlive(c) && this->mesh_.quality(c) < target)
      {
        under.emplace_back(this->mesh_.quality(c), c);
      }
    }
    std::sort(under.begin(), under.end());
    const double worst = this->first(under, this->memory_.failed);
    under.resize(std::min<std::size_t>(under.size(), this->lookAhead_));
    // Not a number, which equals nothing, if there is none at all.
    EXPECT_EQ(asked, std::isnan(worst) ? this->first(under, this->memory_.ahead) : worst);
    ++(std::isnan(worst) ? this->ahead : this->steps);
  }

  long steps = 0, ahead = 0;

private:
  double first(const std::vector<std::pair<double, Index>>& sorted,
    const std::vector<std::uint32_t>& failed) const
  {
    for (const auto& [q, c] : sorted)
    {
      if (this->memory_.hasChanged(this->mesh_, c, failed[c]))
      {
        return q;
      }
    }
    return std::nan("");
  }

  const SimplexMesh<D>& mesh_;
  const ReconnectionMemory<D>& memory_;
  int lookAhead_;
};

/// Three rounds with one memory, as in the paper's alternation, with nodes moved between them.
template <int D>
void takesTheWorst(int lookAhead)
{
  SimplexMesh<D> mesh = buildMesh(jitteredGrid<D>(D == 3 ? 5 : 12, 0.35, 4));
  MeshEditor<D> editor(mesh);
  NodalMetric<D> metric;
  ReconnectionMemory<D> memory;
  Order<D> order(mesh, memory, lookAhead);
  TestRandom random(5);
  for (const double target : { 0.5, 1.0, 1.0 })
  {
    computeQualities<D>(editor, metric, Measure::Shape, 0.0);
    ReconnectionParameters parameters;
    parameters.target = target;
    parameters.lookAhead = lookAhead;
    const ReconnectionResult result = reconnect<D>({ editor, metric, Measure::Shape }, parameters,
      memory,
      [&](double worst)
      {
        order.expect(worst, target);
        return true;
      });
    EXPECT_GT(std::accumulate(result.done.begin(), result.done.end(), result.aheadDone), 0);
    expectSound(mesh);
    // At its end all elements under the target are set aside.
    for (Index c = 0; c < mesh.numberOfCellSlots(); ++c)
    {
      EXPECT_FALSE(mesh.isAlive(c) && mesh.quality(c) < target &&
        memory.hasChanged(mesh, c, memory.failed[c]));
    }
    ++memory.time;
    for (Index p = 0; p < mesh.numberOfPointSlots(); p += 3)
    {
      if (mesh.isPointAlive(p) && mesh.isFree(p))
      {
        editor.movePoint(p, mesh.point(p) + 0.02 * Vec<D>::NullaryExpr([&] { return random(); }));
        std::vector<Index> star;
        editor.star(p, star);
        for (Index c : star)
        {
          for (Index q : mesh.nodes(c))
          {
            memory.touch(q);
          }
        }
      }
    }
  }
  EXPECT_GT(order.steps, 60);
  EXPECT_EQ(order.ahead > 0, lookAhead > 0);
}

TEST(Reconnection, TakesTheWorstThatIsNotSetAside)
{
  takesTheWorst<2>(0);
  takesTheWorst<3>(0);
  takesTheWorst<3>(10);
}

template <int D>
void sameBitsOnEveryRun(int lookAhead)
{
  const MeshInput<D> in = jitteredGrid<D>(D == 3 ? 5 : 12, 0.35, 4);
  SimplexMesh<D> a = buildMesh(in), b = buildMesh(in);
  run<D>(a, {}, lookAhead);
  run<D>(b, {}, lookAhead);
  EXPECT_EQ(bitsOf(a), bitsOf(b));
}

TEST(Reconnection, SameBitsOnEveryRun)
{
  sameBitsOnEveryRun<2>(0);
  sameBitsOnEveryRun<3>(10);
}

template <int D>
void risesLexicographically()
{
  SimplexMesh<D> mesh = buildMesh(jitteredGrid<D>(D == 3 ? 4 : 8, 0.4, 2));
  std::vector<double> before;
  long steps = 0;
  run<D>(mesh, {}, 10,
    [&](double)
    {
      const std::vector<double> now = sortedQualities(mesh);
      EXPECT_TRUE(before.empty() || now == before || isAbove(now, before));
      before = now;
      ++steps;
      return true;
    });
  EXPECT_GT(steps, 20);
}

TEST(Reconnection, SortedQualitiesRiseLexicographically)
{
  risesLexicographically<2>();
  risesLexicographically<3>();
}
