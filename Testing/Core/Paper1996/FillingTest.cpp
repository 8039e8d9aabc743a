// SPDX-License-Identifier: BSD-3-Clause
// What is tried around one element: every filling of a hexagon by hand, the rules on whole meshes.
#include "Paper1996/Filling.h"
#include "Run/Summary.h"
#include "TestMeshes.h"

using namespace meshopt;

namespace
{
template <class>
class Fillings : public ::testing::Test
{
};
TYPED_TEST_SUITE(Fillings, TestDimensions);

/// One filling: its kind, the core of its cluster, and the id of its apex.
struct Tried
{
  Filling kind;
  std::array<Index, 2> core;
  Index apex;
  bool operator==(const Tried& o) const
  {
    return this->kind == o.kind && this->core == o.core && this->apex == o.apex;
  }
};

std::ostream& operator<<(std::ostream& out, const Tried& t)
{
  return out << static_cast<int>(t.kind) << ":(" << t.core[0] << "," << t.core[1] << ")" << t.apex;
}

/// A hexagon around node 0, which is nearest to the side (1, 2): cell 0 is the worst of all.
MeshInput<2> hexagon()
{
  MeshInput<2> in;
  in.points.emplace_back(0.7, 0.1);
  for (int k = 0; k < 6; ++k)
  {
    in.points.emplace_back(std::cos(k * M_PI / 3.0), std::sin(k * M_PI / 3.0));
    in.cells.push_back({ 0, 1 + k, 1 + (k + 1) % 6 });
  }
  return in;
}

/// A mesh with its qualities, and the memory of an iteration that begins.
template <int D>
struct Scene
{
  SimplexMesh<D> mesh;
  MeshEditor<D> editor;
  ReconnectionMemory<D> memory;

  explicit Scene(const MeshInput<D>& in)
    : mesh(buildMesh(in))
    , editor(this->mesh)
  {
    NodalMetric<D> metric;
    computeQualities<D>(this->editor, metric, Measure::Shape, 0.0);
    this->memory.resize(this->mesh);
  }

  std::vector<Tried> tried(Index c, std::uint32_t when = 0)
  {
    ElementClusters<D> clusters;
    clusters.gather(this->editor, c, this->memory, when);
    std::vector<Tried> all;
    const bool stopped = clusters.forEach(this->mesh,
      [&](const ElementCluster<D>& around, Filling kind, const Apex<D>& apex)
      {
        all.push_back({ kind, around.core, apex.id });
        return false;
      });
    EXPECT_FALSE(stopped);
    return all;
  }
};

constexpr Filling Ring = Filling::RingNode, Open = Filling::OpenRing, Away = Filling::BoundaryNode,
                  Centre = Filling::Centre, New = Filling::NewCentre, Middle = Filling::Midpoint;
}

TEST(ReconnectionMemory, KnowsWhatHasChangedSince)
{
  Scene<2> s(hexagon());
  ReconnectionMemory<2>& memory = s.memory;
  EXPECT_EQ(memory.time, 1u);
  EXPECT_EQ(memory.failed, std::vector<std::uint32_t>(6, 0));
  EXPECT_EQ(memory.ahead, std::vector<std::uint32_t>(6, 0));
  EXPECT_EQ(memory.changed, std::vector<std::uint32_t>(7, 1));
  for (Index c = 0; c < 6; ++c)
  {
    EXPECT_TRUE(memory.hasChanged(s.mesh, c, 0));
    EXPECT_FALSE(memory.hasChanged(s.mesh, c, 1));
  }
  memory.time = 5;
  memory.touch(2); // of the cells 0 and 1
  for (Index c = 0; c < 6; ++c)
  {
    EXPECT_EQ(memory.hasChanged(s.mesh, c, 4), c <= 1);
    EXPECT_FALSE(memory.hasChanged(s.mesh, c, 5));
  }
  // What comes has changed just now, what is there stays remembered.
  memory.failed[3] = 4;
  const Index p = s.editor.addPoint(Vec<2>::Zero());
  memory.resize(s.mesh);
  EXPECT_EQ(memory.time, 5u);
  EXPECT_EQ(memory.failed[3], 4u);
  EXPECT_EQ(memory.changed[2], 5u);
  EXPECT_EQ(memory.changed[p], 1u);
}

TEST(ElementCluster, KindOfItsFillings)
{
  ElementCluster<3> around;
  around.core = { 4, 5 };
  EXPECT_TRUE(around.isEdge());
  EXPECT_EQ(around.kindFromBoundary(), Open);
  around.cluster.closed = true;
  EXPECT_EQ(around.kindFromBoundary(), Ring);
  around.core = { 4, None };
  EXPECT_FALSE(around.isEdge());
  EXPECT_EQ(around.kindFromBoundary(), Open);
  around.cluster.coreInside = true;
  EXPECT_EQ(around.kindFromBoundary(), Away);
}

TEST(ElementClusters, AllFillingsOfAHexagonInTheirOrder)
{
  const std::vector<Tried> wanted{ { Ring, { 0, 1 }, 2 },
    { Ring, { 0, 1 }, 6 }, // edge clusters from ring nodes
    { Ring, { 0, 2 }, 1 }, { Ring, { 0, 2 }, 3 }, { Open, { 1, 2 }, 0 }, { Centre, { 0, None }, 0 },
    { New, { 1, None }, None }, { New, { 2, None }, None }, { Away, { 0, None }, 1 },
    { Away, { 0, None }, 2 }, { Away, { 0, None }, 3 }, { Away, { 0, None }, 4 },
    { Away, { 0, None }, 5 }, { Away, { 0, None }, 6 }, { Open, { 1, None }, 0 },
    { Open, { 1, None }, 2 }, { Open, { 1, None }, 6 }, { Open, { 2, None }, 0 },
    { Open, { 2, None }, 1 }, { Open, { 2, None }, 3 }, { Middle, { 0, 1 }, None },
    { Middle, { 0, 2 }, None } };
  EXPECT_EQ(Scene<2>(hexagon()).tried(0), wanted);
}

TEST(ElementClusters, PlacesOfApexesThatAreNoPointOfTheCluster)
{
  Scene<2> s(hexagon());
  ElementClusters<2> clusters;
  clusters.gather(s.editor, 0, s.memory, 0);
  clusters.forEach(s.mesh,
    [&](const ElementCluster<2>& around, Filling kind, const Apex<2>& apex)
    {
      Vec<2> wanted = s.mesh.point(std::max(apex.id, 0));
      const Vec<2> a = s.mesh.point(0), b = s.mesh.point(1), c = s.mesh.point(2);
      if (kind == Centre)
      {
        wanted = Vec<2>::Zero(); // the mean of a hexagon
      }
      else if (kind == New)
      {
        wanted = (a + b + c + s.mesh.point(around.core[0] == 1 ? 6 : 3)) / 4.0;
      }
      else if (kind == Middle)
      {
        wanted = 0.5 * (s.mesh.point(around.core[0]) + s.mesh.point(around.core[1]));
      }
      EXPECT_LT((apex.x - wanted).norm(), 1e-15);
      const bool isOfCluster = kind == Ring || kind == Open || kind == Away;
      EXPECT_EQ(apex.local >= 0, isOfCluster);
      EXPECT_TRUE(apex.local < 0 || around.cluster.points[apex.local] == apex.id);
      return false;
    });
}

TEST(ElementClusters, AFixedNodeStaysWhereItIs)
{
  MeshInput<2> in = hexagon();
  in.fixedPoints.assign(7, 0);
  in.fixedPoints[0] = 1;
  std::vector<Tried> wanted = Scene<2>(hexagon()).tried(0);
  wanted.erase(std::remove_if(wanted.begin(), wanted.end(),
                 [](const Tried& t) { return t.kind == Centre || t.kind == Away; }),
    wanted.end());
  EXPECT_EQ(Scene<2>(in).tried(0), wanted);
}

TEST(ElementClusters, OnlyWhatHasChanged)
{
  Scene<2> s(hexagon());
  EXPECT_TRUE(s.tried(0, 1).empty());
  s.memory.time = 2;
  s.memory.touch(1); // the node cluster of node 1; an edge cluster needs both of its nodes
  EXPECT_EQ(s.tried(0, 1),
    std::vector<Tried>({ { New, { 1, None }, None }, { Open, { 1, None }, 0 },
      { Open, { 1, None }, 2 }, { Open, { 1, None }, 6 } }));
  s.memory.touch(2);
  EXPECT_EQ(s.tried(0, 1).front(), (Tried{ Open, { 1, 2 }, 0 }));
  EXPECT_EQ(s.tried(0, 1).size(), 1u + 2u + 3u + 3u);
}

TEST(ElementClusters, EndsWithTheFirstThatIsTaken)
{
  Scene<2> s(hexagon());
  ElementClusters<2> clusters;
  clusters.gather(s.editor, 0, s.memory, 0);
  const std::size_t all = s.tried(0).size();
  for (std::size_t stop = 1; stop <= all; ++stop)
  {
    std::size_t calls = 0;
    EXPECT_TRUE(clusters.forEach(
      s.mesh, [&](const ElementCluster<2>&, Filling, const Apex<2>&) { return ++calls == stop; }));
    EXPECT_EQ(calls, stop);
  }
}

/// Of every cell: how many fillings there are, from its clusters gathered one by one.
TYPED_TEST(Fillings, AreThoseOfTheClustersThatItIsTheWorstOf)
{
  constexpr int D = TypeParam::dimension;
  Scene<D> s(jitteredGrid<D>(D == 2 ? 6 : 3, 0.25, 2));
  FanCluster<D> cluster;
  std::size_t total = 0;
  for (Index c = 0; c < s.mesh.numberOfCellSlots(); ++c)
  {
    const Simplex<D> nodes = s.mesh.nodes(c);
    std::size_t wanted = 0;
    for (const auto& e : Local<D>::edges)
    {
      const Index core[] = { nodes[e[0]], nodes[e[1]] };
      if (gatherFanCluster<D>(s.editor, c, core, 2, cluster))
      {
        wanted += cluster.points.size() - 2 + (cluster.closed ? 1 : 0);
      }
    }
    for (Index p : nodes)
    {
      if (gatherFanCluster<D>(s.editor, c, &p, 1, cluster))
      {
        wanted += cluster.points.size() + (cluster.coreInside ? 1 : 0); // and the centre
      }
    }
    const std::vector<Tried> tried = s.tried(c);
    EXPECT_EQ(tried.size(), wanted) << "cell " << c;
    total += tried.size();
    // Groups follow each other, and within a cluster apexes ascend.
    const auto group = [](const Tried& t)
    {
      return t.kind == Middle               ? 3
        : t.kind == Centre || t.kind == New ? 1
        : t.core[1] == None                 ? 2
                                            : 0;
    };
    for (std::size_t k = 1; k < tried.size(); ++k)
    {
      EXPECT_LE(group(tried[k - 1]), group(tried[k]));
      EXPECT_TRUE(tried[k].core != tried[k - 1].core || group(tried[k]) != group(tried[k - 1]) ||
        tried[k - 1].apex < tried[k].apex);
    }
  }
  EXPECT_GT(total, 100u);
}
