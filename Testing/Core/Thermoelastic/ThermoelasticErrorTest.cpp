// SPDX-License-Identifier: BSD-3-Clause
// Everything that cannot be solved is an error that says what and where; rigid motions are found,
// named and pinned.
#include "Thermoelastic/Loads.h"
#include "Thermoelastic/RigidModes.h"
#include "ThermoelasticTesting.h"

using namespace meshopt;
using namespace meshopt::fem;

template <class T>
class ThermoelasticError : public ::testing::Test
{
};
TYPED_TEST_SUITE(ThermoelasticError, TestDimensions);

namespace
{
template <int D>
Error errorOf(
  const SimplexMesh<D>& mesh, const Problem<D>& problem, const AnalysisOptions& options = {})
{
  Solution<D> s;
  const auto error = analyse(mesh, problem, options, {}, s);
  EXPECT_TRUE(error);
  EXPECT_TRUE(s.displacement.empty());
  return error ? *error : Error();
}

void expectWords(const Error& error, const std::vector<std::string>& words)
{
  for (const std::string& word : words)
  {
    EXPECT_NE(error.message.find(word), std::string::npos) << word << " in: " << error.message;
  }
}

template <int D>
Problem<D> held(const SimplexMesh<D>& mesh)
{
  Problem<D> problem;
  problem.temperature.assign(mesh.numberOfPointSlots(), 100.0);
  prescribeSurface<D>(
    mesh, [](const Vec<D>&) { return Vec<D>(Vec<D>::Zero()); }, problem);
  return problem;
}

const double NaN = std::numeric_limits<double>::quiet_NaN();
}

TYPED_TEST(ThermoelasticError, Material)
{
  constexpr int D = TypeParam::dimension;
  const SimplexMesh<D> mesh = box<D>(3, 0.1);
  const Problem<D> good = held(mesh);
  Problem<D> p = good;
  p.materials = { { 1.0, 0.5, 0.0 } };
  expectWords(errorOf(mesh, p), { "Poisson's ratio", "0.5", "incompressible" });
  p.materials = { { 1.0, -1.0, 0.0 } };
  expectWords(errorOf(mesh, p), { "Poisson's ratio", "-1" });
  p.materials = { { 0.0, 0.3, 0.0 } };
  expectWords(errorOf(mesh, p), { "Young's modulus is 0" });
  p.materials = { { NaN, 0.3, 0.0 } };
  expectWords(errorOf(mesh, p), { "Young's modulus is nan" });
  p.materials = { { 1.0, 0.3, NaN } };
  expectWords(errorOf(mesh, p), { "thermal expansion" });
  p.materials.assign(mesh.numberOfCellSlots(), Material());
  p.materials[5].youngsModulus = -2.0;
  EXPECT_EQ(errorOf(mesh, p).cell, 5);
  expectWords(errorOf(mesh, p), { "cell 5", "-2" });
  p.materials.resize(2);
  expectWords(errorOf(mesh, p), { "2 values", "cells" });
  p.materials.clear();
  expectWords(errorOf(mesh, p), { "0 values" });
}

TYPED_TEST(ThermoelasticError, Fields)
{
  constexpr int D = TypeParam::dimension;
  const SimplexMesh<D> mesh = box<D>(3, 0.1);
  const Problem<D> good = held(mesh);
  Problem<D> p = good;
  p.temperature[7] = NaN;
  EXPECT_EQ(errorOf(mesh, p).point, 7);
  expectWords(errorOf(mesh, p), { "temperature", "point 7", "nan" });
  p = good;
  p.temperature.pop_back();
  expectWords(errorOf(mesh, p), { "Temperature", "points" });
  p = good;
  p.referenceTemperature = NaN;
  expectWords(errorOf(mesh, p), { "reference temperature" });
  p = good;
  p.forces.assign(mesh.numberOfPointSlots(), Vec<D>::Zero());
  p.forces[3][1] = NaN;
  expectWords(errorOf(mesh, p), { "load", "point 3" });
  p = good;
  p.constraints.push_back({ 4, 1, NaN });
  expectWords(errorOf(mesh, p), { "prescribed displacement", "point 4" });
  p = good;
  p.constraints.push_back({ -2, 1, 0.0 });
  expectWords(errorOf(mesh, p), { "point -2" });
  p = good;
  p.constraints.push_back({ 2, D, 0.0 });
  expectWords(errorOf(mesh, p), { "component" });
  p = good;
  p.outOfPlaneStrain = NaN;
  expectWords(errorOf(mesh, p), { "strain" });
  AnalysisOptions options;
  options.solver.tolerance = 0.0;
  expectWords(errorOf(mesh, good, options), { "tolerance" });
  options.solver.tolerance = 1e-8;
  options.solver.maximumNumberOfIterations = 0;
  expectWords(errorOf(mesh, good, options), { "iteration" });
  expectWords(errorOf(SimplexMesh<D>(), Problem<D>()), { "no elements" });
}

TYPED_TEST(ThermoelasticError, InvertedAndFlatCells)
{
  constexpr int D = TypeParam::dimension;
  MeshInput<D> in = jitteredGrid<D>(3, 0.0);
  Index inner = 0;
  while ((in.points[inner] - Vec<D>::Constant(1.0 / 3.0)).norm() > 1e-9)
  {
    ++inner;
  }
  const Vec<D> home = in.points[inner];
  in.points[inner][0] += 0.5; // across its neighbour
  const SimplexMesh<D> inverted = buildMesh(in);
  const Error error = errorOf(inverted, held(inverted));
  expectWords(error, { "Cell " + std::to_string(error.cell) + " is inverted", "-0." });
  EXPECT_LT(signedVolume(inverted.corners(error.cell)), 0.0);

  in.points[inner] = home;
  in.points[inner][0] += 1.0 / 3.0; // onto its neighbour
  const SimplexMesh<D> flat = buildMesh(in);
  const Error zero = errorOf(flat, held(flat));
  expectWords(zero, { "is flat" });
  EXPECT_NE(zero.cell, None);
}

// The motion that is left is named, and pinned by as many constraints as needed.
TEST(ThermoelasticRigid, NamedInSpace)
{
  const SimplexMesh<3> mesh = box<3>(2, 0.1);
  Problem<3> p;
  expectWords(errorOf(mesh, p), { "no constraints", "translate and rotate freely" });

  const auto hold = [&](Index point, std::initializer_list<int> components)
  {
    for (int i : components)
    {
      p.constraints.push_back({ point, i, 0.0 });
    }
  };
  hold(0, { 0, 1, 2 }); // the corner at the origin: rotations about it are left
  const Error ball = errorOf(mesh, p);
  expectWords(ball, { "too few", "rotate about the axis through (0, " });
  EXPECT_EQ(ball.message.find("translate"), std::string::npos);
  hold(2, { 0, 1, 2 }); // (1, 0, 0): a hinge along x
  expectWords(errorOf(mesh, p), { "rotate about the axis through (0.5, 0, 0) along (1, 0, 0)." });
  EXPECT_EQ(pinRigidMotions(mesh, findRigidModes(mesh, p.constraints)).size(), 1u);
  hold(6, { 2 }); // (0, 1, 0) in z: held
  EXPECT_EQ(findRigidModes(mesh, p.constraints).count(), 0);

  p.constraints.clear();
  for (Index q = 0; q < mesh.numberOfPointSlots(); ++q)
  {
    hold(q, { 2 });
  }
  const Error plane = errorOf(mesh, p);
  expectWords(plane,
    { "the mesh can translate along (1, 0, 0); the mesh can translate along (0, 1, 0); the mesh "
      "can "
      "rotate about the axis through (0.5, 0.5, 0.5) along (0, 0, 1)." });
}

TEST(ThermoelasticRigid, NamedInThePlane)
{
  const SimplexMesh<2> mesh = box<2>(2, 0.1);
  Problem<2> p;
  expectWords(errorOf(mesh, p), { "translate and rotate freely" });
  p.constraints = { { 0, 1, 0.0 } };
  expectWords(errorOf(mesh, p), { "translate along (1, 0)", "rotate about the point (0" });
  p.constraints = { { 2, 0, 0.0 }, { 2, 1, 0.0 } };
  expectWords(errorOf(mesh, p), { "rotate about the point (1, 0)." });
}

// Whatever is held, pins leave nothing free and take no more than needed.
TEST(ThermoelasticRigid, PinsAreEnough)
{
  const SimplexMesh<3> mesh = box<3>(2, 0.1);
  TestRandom random(3);
  for (int round = 0; round < 200; ++round)
  {
    std::vector<Constraint> constraints;
    const int n = round % 8;
    for (int i = 0; i < n; ++i)
    {
      constraints.push_back({ static_cast<Index>((random() + 1.0) * 13.0),
        static_cast<int>((random() + 1.0) * 1.49), 0.0 });
    }
    const RigidModes<3> modes = findRigidModes(mesh, constraints);
    EXPECT_GE(modes.count(), 6 - n);
    const auto pins = pinRigidMotions(mesh, modes);
    EXPECT_EQ(static_cast<int>(pins.size()), modes.count());
    constraints.insert(constraints.end(), pins.begin(), pins.end());
    EXPECT_EQ(findRigidModes(mesh, constraints).count(), 0);
  }
}

namespace
{
/// The box and its mirror image at x = 0, sharing what `share` says of the points on the plane.
template <int D>
SimplexMesh<D> twins(const std::function<bool(const Vec<D>&)>& share)
{
  MeshInput<D> in = jitteredGrid<D>(2, 0.0);
  const Index n = static_cast<Index>(in.points.size());
  const std::size_t cells = in.cells.size();
  std::vector<Index> twin(n);
  for (Index p = 0; p < n; ++p)
  {
    Vec<D> x = in.points[p];
    twin[p] = p;
    if (x[0] != 0.0 || !share(x))
    {
      x[0] = -x[0];
      twin[p] = static_cast<Index>(in.points.size());
      in.points.push_back(x);
    }
  }
  for (std::size_t c = 0; c < cells; ++c)
  {
    Simplex<D> cell;
    for (int i = 0; i <= D; ++i)
    {
      cell[i] = twin[in.cells[c][i]];
    }
    in.cells.push_back(cell);
  }
  return buildMesh(in);
}
}

// Bodies that touch at points or edges only are hinged, and the hinge is free.
TEST(ThermoelasticRigid, Hinges)
{
  const auto free = [](const SimplexMesh<3>& mesh) { return findRigidModes(mesh, {}).count(); };
  EXPECT_EQ(free(twins<3>([](const Vec<3>&) { return true; })), 6);
  EXPECT_EQ(free(twins<3>([](const Vec<3>&) { return false; })), 12);
  EXPECT_EQ(free(twins<3>([](const Vec<3>& x) { return x[1] == 0.0; })), 7);        // an edge
  EXPECT_EQ(free(twins<3>([](const Vec<3>& x) { return x[1] + x[2] == 0.0; })), 9); // a point
  EXPECT_EQ(findRigidModes(twins<2>([](const Vec<2>& x) { return x[1] == 0.0; }), {}).count(), 4);

  // One held, the other hangs on it by an edge: the message says which part moves, and how.
  const SimplexMesh<3> mesh = twins<3>([](const Vec<3>& x) { return x[1] == 0.0; });
  Problem<3> p;
  for (Index q = 0; q < mesh.numberOfPointSlots(); ++q)
  {
    for (int i = 0; i < 3 && mesh.point(q)[0] == 1.0; ++i)
    {
      p.constraints.push_back({ q, i, 0.0 });
    }
  }
  expectWords(errorOf(mesh, p),
    { "part of the mesh that holds cell 48 (48 cells)", "rotate about the axis through (0, 0, ",
      "along (0, 0, 1)" });
  p.rigidMotion = RigidMotion::Pin;
  p.temperature.assign(mesh.numberOfPointSlots(), 10.0);
  const Solution<3> s = solveOrFail(mesh, p);
  EXPECT_EQ(s.pins.size(), 1u);
}

// Any number of parts, each by itself.
TEST(ThermoelasticRigid, ManyParts)
{
  MeshInput<2> in;
  const Index n = 2000;
  for (Index k = 0; k < n; ++k)
  {
    const Index first = 3 * k;
    in.points.push_back(Vec<2>(2.0 * k, 0.0));
    in.points.push_back(Vec<2>(2.0 * k + 1.0, 0.0));
    in.points.push_back(Vec<2>(2.0 * k, 1.0));
    in.cells.push_back({ first, first + 1, first + 2 });
  }
  const SimplexMesh<2> mesh = buildMesh(in);
  const RigidModes<2> modes = findRigidModes(mesh, {});
  EXPECT_EQ(modes.count(), 3 * n);
  expectWords({ modes.describe() }, { "holds cell 0 (1 cells)", "holds cell 1", "more" });
  const std::vector<Constraint> pins = pinRigidMotions(mesh, modes);
  EXPECT_EQ(static_cast<Index>(pins.size()), 3 * n);
  EXPECT_EQ(findRigidModes(mesh, pins).count(), 0);
}

// A chain of triangles with more links than are looked at one by one: held or not, as one body.
TEST(ThermoelasticRigid, LongChain)
{
  MeshInput<2> in;
  in.points.push_back(Vec<2>::Zero());
  for (Index k = 0; k < 2 * MostBodiesInGroup; ++k)
  {
    in.points.push_back(Vec<2>(k + 0.5, 1.0));
    in.points.push_back(Vec<2>(k + 1.0, 0.0));
    in.cells.push_back({ 2 * k, 2 * k + 2, 2 * k + 1 });
  }
  const SimplexMesh<2> mesh = buildMesh(in);
  EXPECT_EQ(findRigidModes(mesh, {}).count(), 3);
  EXPECT_EQ(findRigidModes(mesh, { { 0, 0, 0.0 }, { 0, 1, 0.0 }, { 50, 1, 0.0 } }).count(), 0);
}

// Loads that nothing holds against.
TYPED_TEST(ThermoelasticError, LoadsOutOfEquilibrium)
{
  constexpr int D = TypeParam::dimension;
  const SimplexMesh<D> mesh = box<D>(3, 0.1);
  for (const RigidMotion motion : { RigidMotion::Pin, RigidMotion::Project })
  {
    Problem<D> p;
    p.rigidMotion = motion;
    p.forces.assign(mesh.numberOfPointSlots(), Vec<D>::Zero());
    p.forces[1][1] = 3.0;
    expectWords(errorOf(mesh, p), { "not in equilibrium", "the mesh can" });
    p.forces[2][1] = -3.0; // a couple
    expectWords(errorOf(mesh, p), { "not in equilibrium", "rotate" });
    p.forces[1].setZero();
    p.forces[2].setZero();
    p.forces[0][0] = -1.0;
    p.forces[3][0] = 1.0; // pulls along one line
    solveOrFail(mesh, p);
  }
}
