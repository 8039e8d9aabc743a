// SPDX-License-Identifier: BSD-3-Clause
// Facets whose own shape caps their cell very low: weights, and that the neighbours are spared.
#include "Bound/Caps.h"
#include "Bound/ApexBound.h"
#include "Edit/QualityModel.h"
#include "Optimize/Optimizer.h"
#include "Run/Summary.h"
#include "TestMeshes.h"

#include <map>

using namespace meshopt;

namespace
{
using Shape3 = MeanEdgeShape<3>;

/// A cube; every other node inside two of its sides lies `gap` of an edge from a neighbour of it.
MeshInput<3> withNeedles(int n, double gap)
{
  MeshInput<3> in = jitteredGrid<3>(n, 0.2);
  for (Vec<3>& x : in.points)
  {
    const Vec<3> at = x * n;
    const auto isOddInside = [&](int d)
    { return std::lround(at[d]) % 2 == 1 && at[d] > 0.5 && at[d] < n - 0.5; };
    if ((x[2] == 0.0 || x[2] == 1.0) && isOddInside(0) && isOddInside(1))
    {
      x[0] -= (1.0 - gap) / n;
    }
  }
  return in;
}

/// Facets of the surface with their caps, by sorted nodes.
std::map<Facet<3>, double> facetCaps(const SimplexMesh<3>& mesh)
{
  std::map<Facet<3>, double> caps;
  for (Index c = 0; c < mesh.numberOfCellSlots(); ++c)
  {
    for (int i = 0; i < 4 && mesh.isAlive(c); ++i)
    {
      if (mesh.isKept(c, i))
      {
        Facet<3> f = mesh.facet(c, i);
        const double cap = facetCap(mesh.point(f[0]), mesh.point(f[1]), mesh.point(f[2]));
        std::sort(f.begin(), f.end());
        caps[f] = cap;
      }
    }
  }
  return caps;
}

double capOf(const std::map<Facet<3>, double>& caps, Facet<3> f)
{
  std::sort(f.begin(), f.end());
  const auto found = caps.find(f);
  return found == caps.end() ? 1.0 : found->second;
}
}

TEST(Caps, WeighWhatLiesOnTinyFacets)
{
  SimplexMesh<3> mesh = buildMesh(withNeedles(4, 0.05));
  Caps<3> caps;
  caps.build(mesh, Measure::Shape, 0.6, true);
  caps.setFull(0.9);
  ASSERT_TRUE(caps.hasTiny());
  const std::map<Facet<3>, double> exact = facetCaps(mesh);
  NodalMetric<3> metric;
  QualityModel<3, Shape3> plain(mesh, metric, 0.0), weighed = plain;
  EXPECT_TRUE(plain.fast());
  weighed.weights = &caps;
  EXPECT_FALSE(weighed.fast());
  int tiny = 0, usual = 0;
  for (Index c = 0; c < mesh.numberOfCellSlots(); ++c)
  {
    const Simplex<3>& nodes = mesh.nodes(c);
    double greatest = 1.0;
    for (int i = 0; i < 4; ++i)
    {
      Facet<3> f = mesh.facet(c, i);
      const double cap = capOf(exact, f);
      const double expected = cap < Caps<3>::Tiny ? 0.9 / cap : 1.0;
      ++(expected > 1.0 ? tiny : usual);
      greatest = std::max(greatest, expected);
      std::sort(f.begin(), f.end());
      do
      {
        EXPECT_NEAR(caps.weight(f), expected, 1e-6 * expected);
      } while (std::next_permutation(f.begin(), f.end()));
    }
    EXPECT_NEAR(caps.weight(nodes), greatest, 1e-6 * greatest);
    EXPECT_EQ(weighed(nodes), plain(nodes) * caps.weight(nodes));
    weighed.floor = 2 * plain(nodes); // it is worse: it has to be seen as what it is
    EXPECT_EQ(weighed(nodes), plain(nodes));
    weighed.floor = 0.0;
  }
  EXPECT_GT(tiny, 8);
  EXPECT_GT(usual, 100);
  caps.build(mesh, Measure::Shape, 0.6, false);
  EXPECT_FALSE(caps.hasTiny());
}

/// Where two points coincide caps are nothing but rounding, and weights would make qualities of it.
TEST(Caps, FacetsWithoutAreaHaveNoEndlessGains)
{
  for (double gap : { 0.0, 1e-15 })
  {
    SimplexMesh<3> mesh = buildMesh(withNeedles(4, gap));
    Control control;
    control.deadline = deadlineIn(30.0);
    NodalMetric<3> metric;
    const Report report = optimize<3>(mesh, metric, Options(), control);
    EXPECT_NE(report.stopReason, StopReason::TimeLimit);
    EXPECT_TRUE(mesh.audit(false).empty());
  }
}

TEST(Caps, WithoutTinyFacetsAllWeighTheSame)
{
  SimplexMesh<3> mesh = buildMesh(jitteredGrid<3>(3, 0.2));
  Caps<3> caps;
  caps.build(mesh, Measure::Shape, 0.9, true);
  caps.setFull(0.9);
  EXPECT_FALSE(caps.hasTiny());
  for (Index c = 0; c < mesh.numberOfCellSlots(); ++c)
  {
    EXPECT_EQ(caps.weight(mesh.nodes(c)), 1.0);
  }
}

/// A cell with the best apex on a needle has neighbours at the needle's short edge that are no
/// better.
TEST(Caps, CellsBesideTinyFacetsAreSpared)
{
  SimplexMesh<3> mesh = buildMesh(withNeedles(8, 0.06));
  const std::map<Facet<3>, double> caps = facetCaps(mesh);
  Options options;
  options.algorithm = Algorithm::WorstFirst;
  NodalMetric<3> metric;
  const Report report = optimize<3>(mesh, metric, options, Control());
  EXPECT_GT(report.worstAfter, report.worstBefore);
  EXPECT_LE(report.worstAfter, report.bound);
  int onTiny = 0, bad = 0;
  for (Index c = 0; c < mesh.numberOfCellSlots(); ++c)
  {
    if (mesh.isAlive(c))
    {
      EXPECT_EQ(mesh.quality(c), Shape3::value(mesh.corners(c))); // no weight remains
      double cap = 1.0;
      for (int i = 0; i < 4; ++i)
      {
        cap = std::min(cap, capOf(caps, mesh.facet(c, i)));
      }
      onTiny += cap < Caps<3>::Tiny;
      bad += cap >= Caps<3>::Tiny && mesh.quality(c) < Caps<3>::Tiny;
    }
  }
  EXPECT_GT(onTiny, 20);
  EXPECT_LE(bad, onTiny / 8); // without weights more than half as many
}
