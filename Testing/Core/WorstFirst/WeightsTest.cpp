// SPDX-License-Identifier: BSD-3-Clause
// Qualities weighed and as they are: what the mesh holds after each switch, and the floor.
#include "WorstFirst/Weights.h"
#include "TestBench.h"

using namespace meshopt;

namespace
{
using Shape3 = MeanEdgeShape<3>;

constexpr double Full = 0.9; // what a weighed cell has at its cap

/// A cube; a point of its surface lies close to an edge of it, at this part of the way.
MeshInput<3> withFlatFacets(double gap)
{
  MeshInput<3> in = jitteredGrid<3>(4, 0.2);
  *std::find(in.points.begin(), in.points.end(), Vec<3>(0.25, 0.5, 0.0)) = { 0.25 * gap, 0.5, 0.0 };
  return in;
}

struct Weighed
{
  explicit Weighed(double gap)
    : bench(withFlatFacets(gap))
    , weights(bench.editor, bench.model, caps)
  {
    this->caps.build(this->bench.mesh, Measure::Shape, 0.6, true);
    this->caps.setFull(Full);
  }
  std::vector<double> stored() const
  {
    std::vector<double> q;
    for (Index c = 0; c < this->bench.mesh.numberOfCellSlots(); ++c)
    {
      q.push_back(this->bench.mesh.quality(c));
    }
    return q;
  }

  Caps<3> caps;
  Bench<3> bench;
  Weights<3, Shape3> weights;
};
}

TEST(Weights, OnIsTimesTheWeightButNotUnderTheFloor)
{
  Weighed w(0.1);
  ASSERT_TRUE(w.caps.hasTiny());
  const std::vector<double> plain = w.stored();
  const double worst = *std::min_element(plain.begin(), plain.end());
  EXPECT_FALSE(w.weights.areOn());
  w.weights.switchOn();
  EXPECT_TRUE(w.weights.areOn());
  EXPECT_EQ(w.bench.model.floor, worst);
  int raised = 0;
  for (Index c = 0; c < w.bench.mesh.numberOfCellSlots(); ++c)
  {
    const double weight = w.caps.weight(w.bench.mesh.nodes(c));
    EXPECT_EQ(w.bench.mesh.quality(c), plain[c] * weight)
      << c; // the worst is at the floor, not under
    EXPECT_LE(w.bench.mesh.quality(c), std::max(Full, plain[c]) + 1e-6);
    raised += weight > 1.0;
  }
  EXPECT_GE(raised, 1);
  w.weights.switchOff();
  EXPECT_FALSE(w.weights.areOn());
  EXPECT_EQ(w.stored(), plain); // the bits
}

/// Switched on again, what is the worst by then is the floor: cells that have got worse are seen as
/// what they are.
TEST(Weights, TheFloorIsWhatIsTheWorst)
{
  Weighed w(0.1);
  w.weights.switchOn();
  const double first = w.bench.model.floor;
  w.weights.switchOff();
  Index flat = None; // a cell on a tiny facet that is not the worst of all
  for (Index c = 0; c < w.bench.mesh.numberOfCellSlots(); ++c)
  {
    const double weight = w.caps.weight(w.bench.mesh.nodes(c));
    flat = weight > 1.0 ? c : flat;
  }
  ASSERT_NE(flat, None);
  // all but that cell are good now: the floor rises to it
  for (Index c = 0; c < w.bench.mesh.numberOfCellSlots(); ++c)
  {
    if (w.caps.weight(w.bench.mesh.nodes(c)) == 1.0)
    {
      w.bench.editor.setQuality(c, 0.8);
    }
  }
  w.weights.switchOn();
  EXPECT_GE(w.bench.model.floor, first);
  w.weights.switchOff();
  // a cell under the floor keeps its quality
  const Simplex<3> nodes = w.bench.mesh.nodes(flat);
  w.weights.switchOn();
  w.bench.model.floor = 1.0;
  EXPECT_EQ(w.bench.model(nodes), Shape3::value(w.bench.mesh.corners(flat)));
  w.bench.model.floor = 0.0;
  EXPECT_GT(w.bench.model(nodes), Shape3::value(w.bench.mesh.corners(flat)));
}

TEST(Weights, InvertedCellsGiveNoFloorUnderZero)
{
  Weighed w(0.1);
  w.bench.editor.setQuality(0, -0.5);
  w.weights.switchOn();
  EXPECT_EQ(w.bench.model.floor, 0.0);
}

TEST(Weights, WithoutTinyFacetsNothingHappens)
{
  Weighed w(1.0);
  ASSERT_FALSE(w.caps.hasTiny());
  const std::vector<double> plain = w.stored();
  w.weights.switchOn();
  EXPECT_FALSE(w.weights.areOn());
  EXPECT_EQ(w.stored(), plain);
  w.weights.switchOff();
  EXPECT_EQ(w.stored(), plain);
  EXPECT_EQ(w.bench.model.floor, 0.0);
}

/// Capped is by what a cell is, weighed or not.
TEST(Weights, WhatIsCappedStaysCapped)
{
  Weighed w(0.1);
  std::vector<bool> capped;
  for (Index c = 0; c < w.bench.mesh.numberOfCellSlots(); ++c)
  {
    capped.push_back(w.caps.isCapped(w.bench.mesh, c));
  }
  w.weights.switchOn();
  for (Index c = 0; c < w.bench.mesh.numberOfCellSlots(); ++c)
  {
    EXPECT_EQ(w.caps.isCapped(w.bench.mesh, c), capped[c]) << c;
  }
}
