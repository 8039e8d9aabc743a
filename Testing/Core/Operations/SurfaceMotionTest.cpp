// SPDX-License-Identifier: BSD-3-Clause
// Nodes leave the surface and corners their places, by less than the tolerance.
#include "Operations/SurfaceMotion.h"
#include "SlidingBoxes.h"

using namespace meshopt;

namespace
{
using Motion = SurfaceMotion<3, MeanEdgeShape<3>>;

struct Body
{
  Body(const MeshInput<3>& in, double tolerance)
    : bench(in, &this->surface)
    , input(in)
  {
    SurfaceOptions options;
    options.tolerance = tolerance;
    this->surface.build(this->bench.editor, options);
  }
  /// Tries each cell under .8 once. Returns how often that helped.
  int tryAll()
  {
    Motion motion;
    int done = 0;
    for (Index c = 0; c < this->bench.mesh.numberOfCellSlots(); ++c)
    {
      const double old = this->bench.mesh.quality(c);
      const std::vector<double> before = sortedQualities(this->bench.mesh);
      if (old < 0.8 && motion.improve(this->bench.judge, c, Level::LookAhead))
      {
        ++done;
        EXPECT_GT(sortedQualities(this->bench.mesh), before); // as vectors: the worst decides
      }
    }
    expectSound(this->bench.mesh);
    return done;
  }
  /// How far points of this freedom have moved at most.
  double farthest(Freedom freedom) const
  {
    double most = 0.0;
    for (std::size_t p = 0; p < this->input.points.size(); ++p)
    {
      const auto id = static_cast<Index>(p);
      const double moved = (this->bench.mesh.point(id) - this->input.points[p]).norm();
      most = this->bench.mesh.freedom(id) == freedom ? std::max(most, moved) : most;
    }
    return most;
  }

  SlidingSurface surface;
  Bench<3> bench;
  MeshInput<3> input;
};

TEST(SurfaceMotion, NodesLeaveByLessThanTheTolerance)
{
  MeshInput<3> in = slidingBox(4, 0.3, 23);
  bend(in);
  const std::vector<std::array<Vec<3>, 3>> before = surfaceOf(buildMesh(in));
  constexpr double tolerance = 0.02;
  Body body(in, tolerance);
  EXPECT_GT(body.tryAll(), 10);
  const auto after = surfaceOf(body.bench.mesh);
  const double there = sampledDistance(after, before, 6), back = sampledDistance(before, after, 6);
  const double proved = body.surface.distance(body.bench.mesh);
  EXPECT_GT(there, 0.0);
  EXPECT_LE(std::max(there, back), proved + 1e-12);
  EXPECT_LE(proved, tolerance);
  EXPECT_GT(body.farthest(Freedom::Corner), 0.0);
  EXPECT_LE(body.farthest(Freedom::Corner), 0.6 * tolerance + 1e-12);
}

TEST(SurfaceMotion, WithoutATolerancePlanesAndCornersStay)
{
  const MeshInput<3> in = slidingBox(4, 0.3, 23);
  const std::vector<std::array<Vec<3>, 3>> before = surfaceOf(buildMesh(in));
  Body body(in, 0.0);
  body.tryAll();
  EXPECT_EQ(body.farthest(Freedom::Fixed), 0.0);
  EXPECT_LE(sampledDistance(surfaceOf(body.bench.mesh), before, 4), 1e-15);
}

TEST(SurfaceMotion, WhatTheCallerFixedStays)
{
  MeshInput<3> in = slidingBox(4, 0.3, 23);
  bend(in);
  in.fixedPoints.assign(in.points.size(), 0);
  for (std::size_t p = 0; p < in.points.size(); p += 3)
  {
    in.fixedPoints[p] = 1;
  }
  Body body(in, 0.02);
  EXPECT_GT(body.tryAll(), 1);
  for (std::size_t p = 0; p < in.points.size(); p += 3)
  {
    EXPECT_EQ(body.bench.mesh.point(static_cast<Index>(p)), in.points[p]);
  }
}
}
